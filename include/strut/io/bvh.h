// SPDX-License-Identifier: MIT
// BVH files in and out. BVH names neither its unit nor its up axis and every writer of it differs, so reading gives two
// things: a Motion in metres with Y up, and the file's layout, with which the motion can be written back as it came.
// docs/formats.md lists what is read, what is guessed and what is written.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/core/file.h>
#include <strut/motion/motion.h>

namespace strut {

/// What a file's lengths are counted in.
enum class LengthUnit { kMetre, kCentimetre, kMillimetre, kInch, kFoot };

/// Metres in one `unit`.
double metres_per(LengthUnit unit) noexcept;

/// The unit's English name in the plural: "metres", "centimetres", ...
const char* plural_name(LengthUnit unit) noexcept;

/// The axis that points up in a file. Z up is turned by -90 degrees about X: (x, y, z) becomes (x, z, -y).
enum class UpAxis { kY, kZ };

/// "Y" or "Z".
const char* axis_name(UpAxis up) noexcept;

/// What the position channels of a joint do to its OFFSET. Programs differ where the OFFSET is not zero.
enum class PositionChannels {
  kReplaceOffset,  ///< as Blender and Assimp; an axis without a channel keeps its OFFSET
  kAddToOffset,    ///< as three.js
};

/// One column of a motion row.
enum class BvhChannel { kXPosition, kYPosition, kZPosition, kXRotation, kYRotation, kZRotation };

/// What to take as given when reading; what is not given is guessed and reported.
struct BvhReadOptions {
  std::optional<LengthUnit> unit;  ///< guessed from the skeleton's size if not given
  std::optional<UpAxis> up;        ///< guessed from the skeleton's main axis if not given
  PositionChannels positions = PositionChannels::kReplaceOffset;  ///< for every joint that has position channels
};

/// How a motion is written down. Read layouts reproduce their file: its header to the letter, and its numbers where the
/// motion is unchanged (of the many angles that mean one rotation, the source's).
struct BvhLayout {
  std::vector<std::vector<BvhChannel>> channels;  ///< per joint, in the order of the columns; rotations intrinsic
  LengthUnit unit = LengthUnit::kCentimetre;      ///< of every length in the file
  UpAxis up = UpAxis::kY;                         ///< of the file's axes
  PositionChannels positions = PositionChannels::kReplaceOffset;  ///< what position channels do to OFFSET
  std::string header;           ///< text up to the number of frames, kept to the letter; empty: made from the skeleton
  std::string frame_time_lead;  ///< text between the number of frames and the frame time, if there is a header
  std::string frame_time;       ///< the frame time as printed in the source; empty: made from the frame rate
  double frame_rate = 0.0;      ///< what `frame_time` was read as [frames/s]
  std::shared_ptr<const Skeleton> skeleton;  ///< whose header it is; another one's bones get a header made anew
  std::string line_end = "\n";               ///< "\n" or "\r\n"
  std::shared_ptr<const std::vector<double>> source_values;  ///< the source's rows (frames x channels), or null
  int first_source_row = 0;                                  ///< the row that belongs to the motion's frame 0

  /// Columns of a motion row.
  [[nodiscard]] int num_channels() const noexcept;
};

/// What a BVH file holds.
struct BvhClip {
  Motion motion;     ///< metres, Y up
  BvhLayout layout;  ///< how to write it back
};

/// Reads a BVH file.
/// Throws FileError if it cannot be read, ParseError (line and column) if it is not BVH. Recovered from and reported: a
/// wrong frame count, a truncated last row, unit and up axis that had to be guessed. Cost: one pass, no more memory
/// than a few times the file's size whatever its header claims.
BvhClip read_bvh(const std::string& path, const BvhReadOptions& options = {}, Diagnostics* diagnostics = nullptr);

/// The same from text in memory; `name` stands for the file in messages.
BvhClip parse_bvh(std::string_view text, const std::string& name, const BvhReadOptions& options = {},
                  Diagnostics* diagnostics = nullptr);

/// A layout that every program reads alike: root OFFSET 0 with six channels, three rotations on every other joint.
/// `rotation_order` holds the three rotation channels in the order of their columns.
BvhLayout default_layout(const Skeleton& skeleton, LengthUnit unit = LengthUnit::kCentimetre, UpAxis up = UpAxis::kY,
                         const std::vector<BvhChannel>& rotation_order = {
                             BvhChannel::kZRotation, BvhChannel::kXRotation, BvhChannel::kYRotation});

/// The same channels, to be written in another unit or with another axis up; the header is then made anew.
BvhLayout with_units(const BvhLayout& layout, LengthUnit unit, UpAxis up);

/// The text of a BVH file. Angles are continuous from frame to frame. Where joints between root and pelvis move but
/// have no position channels, the root carries their travel: everything from the pelvis down stays in its place.
/// Reports translations and rotations that the channels cannot express, naming the joints.
/// Throws InvalidArgument if `layout` has another number of joints than the motion.
std::string format_bvh(const Motion& motion, const BvhLayout& layout, Diagnostics* diagnostics = nullptr);

/// Writes format_bvh's text to `path`, all or nothing. Throws also FileError.
void write_bvh(const std::string& path, const Motion& motion, const BvhLayout& layout,
               Overwrite overwrite = Overwrite::kRefuse, Diagnostics* diagnostics = nullptr);

}  // namespace strut
