// SPDX-License-Identifier: MIT
#include "effort/frame_chunks.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include <strut/core/error.h>
#include <strut/math/rotation.h>

namespace strut::effort {
namespace {

static_assert(std::endian::native == std::endian::little, "databases hold little-endian numbers");

constexpr double kStill = 1e-9;  // [m]

template <typename Number>
void put(std::vector<std::byte>& bytes, const Number* numbers, std::size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(numbers);
  bytes.insert(bytes.end(), from, from + count * sizeof(Number));
}

/// Blobs may start anywhere, so numbers are copied out.
template <typename Number>
const std::byte* take(const std::byte* from, Number* numbers, std::size_t count) {
  std::memcpy(numbers, from, count * sizeof(Number));
  return from + count * sizeof(Number);
}

[[noreturn]] void refuse(const std::string& got) {
  throw InvalidArgument("frames", "whole frames of finite numbers", got);
}

bool moves(const Motion& motion, std::size_t joint) {
  const Eigen::Vector3d& first = motion.frames().front().translations[joint];
  for (const Pose& pose : motion.frames()) {
    if ((pose.translations[joint] - first).cwiseAbs().maxCoeff() > kStill) return true;
  }
  return false;
}

}  // namespace

ChunkLayout layout_of(const Motion& motion) {
  ChunkLayout layout{motion.frames().front().translations, {0}};
  for (std::size_t j = 1; j < layout.rest.size(); ++j) {
    if (moves(motion, j)) layout.moving.push_back(static_cast<int>(j));
  }
  return layout;
}

std::vector<std::byte> encode_frames(const Motion& motion, int begin, int end, const ChunkLayout& layout) {
  std::vector<std::byte> bytes;
  bytes.reserve(static_cast<std::size_t>(end - begin) * layout.bytes_per_frame());
  for (int i = begin; i < end; ++i) {
    const Pose& pose = motion.frame(i);
    for (const Eigen::Quaterniond& rotation : pose.rotations) {
      const Eigen::Vector3f vector = math::log_map(rotation).cast<float>();
      put(bytes, vector.data(), 3);
    }
    for (const int joint : layout.moving) put(bytes, pose.translations[static_cast<std::size_t>(joint)].data(), 3);
  }
  return bytes;
}

void decode_frames(std::span<const std::byte> chunk, int begin, int end, const ChunkLayout& layout,
                   std::vector<Pose>& frames) {
  const std::size_t size = layout.bytes_per_frame();
  if (chunk.size() < static_cast<std::size_t>(end) * size) refuse(std::to_string(chunk.size()) + " bytes");
  const std::byte* at = chunk.data() + static_cast<std::size_t>(begin) * size;
  for (int i = begin; i < end; ++i) {
    Pose pose;
    pose.translations = layout.rest;
    pose.rotations.reserve(layout.rest.size());
    for (std::size_t j = 0; j < layout.rest.size(); ++j) {
      Eigen::Vector3f vector;
      at = take(at, vector.data(), 3);
      if (!vector.allFinite()) refuse("a rotation that is none");
      pose.rotations.push_back(math::exp_map(vector.cast<double>()));
    }
    for (const int joint : layout.moving) at = take(at, pose.translations[static_cast<std::size_t>(joint)].data(), 3);
    frames.push_back(std::move(pose));
  }
}

std::vector<std::byte> encode_rest(const ChunkLayout& layout) {
  std::vector<std::byte> bytes;
  for (const Eigen::Vector3d& place : layout.rest) put(bytes, place.data(), 3);
  return bytes;
}

std::vector<std::byte> encode_moving(const ChunkLayout& layout) {
  std::vector<std::byte> bytes;
  for (const std::int32_t joint : layout.moving) put(bytes, &joint, 1);
  return bytes;
}

ChunkLayout decode_layout(std::span<const std::byte> rest, std::span<const std::byte> moving, int num_joints) {
  ChunkLayout layout;
  if (rest.size() != 24 * static_cast<std::size_t>(num_joints) || moving.size() % sizeof(std::int32_t) != 0) {
    refuse("another number of joints");
  }
  const std::byte* at = rest.data();
  for (int j = 0; j < num_joints; ++j) at = take(at, layout.rest.emplace_back().data(), 3);
  at = moving.data();
  for (std::size_t k = 0; k < moving.size() / sizeof(std::int32_t); ++k) {
    std::int32_t joint = 0;
    at = take(at, &joint, 1);
    if (joint < 0 || joint >= num_joints) refuse("joint " + std::to_string(joint));
    layout.moving.push_back(joint);
  }
  return layout;
}

}  // namespace strut::effort
