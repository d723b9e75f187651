// SPDX-License-Identifier: MIT
// Frames as bytes, little-endian: of every frame the rotations of all joints as rotation vectors (float, 12 bytes a
// joint; off by at most 4e-7 rad), then the translations of the joints that move (double, 24 bytes a joint).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <strut/motion/motion.h>

namespace strut::effort {

/// What is the same in all frames of a clip.
struct ChunkLayout {
  std::vector<Eigen::Vector3d> rest;  ///< translations of the joints that do not move [m]
  std::vector<int> moving;            ///< joints whose translations are kept per frame, ascending

  [[nodiscard]] std::size_t bytes_per_frame() const noexcept { return 12 * rest.size() + 24 * moving.size(); }
};

/// How many frames are kept together: fragments read little that they do not need.
inline constexpr int kFramesPerChunk = 64;

/// The joints of `motion` that move by more than 1e-9 m, the root always, and where the others stay.
ChunkLayout layout_of(const Motion& motion);

/// The frames [begin, end) of `motion`.
std::vector<std::byte> encode_frames(const Motion& motion, int begin, int end, const ChunkLayout& layout);

/// Appends the frames [begin, end) of a chunk to `frames`. Throws InvalidArgument if the chunk is too short or a number
/// is not finite.
void decode_frames(std::span<const std::byte> chunk, int begin, int end, const ChunkLayout& layout,
                   std::vector<Pose>& frames);

/// A layout as two blobs and back; `num_joints` is the skeleton's. Throws InvalidArgument for blobs that do not fit.
std::vector<std::byte> encode_rest(const ChunkLayout& layout);
std::vector<std::byte> encode_moving(const ChunkLayout& layout);
ChunkLayout decode_layout(std::span<const std::byte> rest, std::span<const std::byte> moving, int num_joints);

}  // namespace strut::effort
