// SPDX-License-Identifier: MIT
// BVH row by row, for motion that is translated while it is recorded or that is too long to be held: a header, then a
// row in, a pose out, and back. Whole files are read and written by the same code (bvh.h). Memory does not grow.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <strut/io/bvh.h>

namespace strut {

/// Gives up to `size` further bytes at `to`, as they come; 0 at the end. What it throws passes through the reader.
using ReadBytes = std::function<std::size_t(char* to, std::size_t size)>;

/// Reads BVH as it arrives. Asks for bytes only when the row it needs is not there yet, and accepts and refuses what
/// read_bvh does; a row that is cut off is left out only at the very end.
class BvhRowReader {
 public:
  /// Reads the header, and the first row too unless unit and up axis are both given: they are guessed from the header
  /// and that row, and reported. `name` stands for the source in messages; `diagnostics`, if any, must outlive the
  /// reader. Throws ParseError, with line and column; FileError for a header or row of more than 64 MB.
  BvhRowReader(ReadBytes read, const std::string& name, const BvhReadOptions& options = {},
               Diagnostics* diagnostics = nullptr);
  /// The same from text in memory, which must outlive the reader; its first row is always looked at.
  static BvhRowReader of_text(std::string_view text, const std::string& name, const BvhReadOptions& options = {},
                              Diagnostics* diagnostics = nullptr);
  BvhRowReader(BvhRowReader&&) noexcept;
  BvhRowReader& operator=(BvhRowReader&&) noexcept;
  ~BvhRowReader();

  /// The next row [metres, Y up]; false at the end, where a wrong frame count and a cut row are reported.
  /// Throws ParseError for a malformed row; reading cannot go on then. Allocates only while rows grow longer.
  bool next(Pose& pose);

  /// The latest row's numbers as they stand in the file (layout().num_channels()), for BvhRowWriter::row.
  [[nodiscard]] std::span<const double> row() const noexcept;
  /// Rows given so far.
  [[nodiscard]] long long num_rows() const noexcept;
  /// What the header says; 0 where it does not know.
  [[nodiscard]] long long claimed_frames() const noexcept;

  [[nodiscard]] const std::shared_ptr<const Skeleton>& shared_skeleton() const noexcept;
  [[nodiscard]] double frame_rate() const noexcept;
  /// How to write it back; without source values.
  [[nodiscard]] const BvhLayout& layout() const noexcept;

 private:
  struct Source;
  explicit BvhRowReader(std::unique_ptr<Source> source);

  std::unique_ptr<Source> source_;
};

/// Makes the text of a BVH file piece by piece; all pieces in order are what format_bvh gives for the whole.
class BvhRowWriter {
 public:
  /// Throws InvalidArgument if `skeleton` is null, `frame_rate` is not positive, or `layout` has another number of
  /// joints.
  BvhRowWriter(std::shared_ptr<const Skeleton> skeleton, double frame_rate, BvhLayout layout);
  BvhRowWriter(BvhRowWriter&&) noexcept;
  BvhRowWriter& operator=(BvhRowWriter&&) noexcept;
  ~BvhRowWriter();

  /// Everything before the first row. `num_frames` 0 says that the number is not known yet.
  [[nodiscard]] std::string header(long long num_frames) const;

  /// The next row with its line end, valid until the next call. `source`: the row of a file in this layout that the
  /// pose came from, or nothing; where a rotation is still the source's, the source's angles are written. `pose` must
  /// have the skeleton's joints, with unit rotations. Throws InvalidArgument if a size is another.
  const std::string& row(const Pose& pose, std::span<const double> source = {});

  /// Reports translations and rotations of the rows so far that the channels could not express.
  void report(Diagnostics& diagnostics) const;

 private:
  struct Text;
  std::unique_ptr<Text> text_;
};

}  // namespace strut
