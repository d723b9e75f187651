// SPDX-License-Identifier: MIT
// A caller's pose, joint by joint: strides resolved, and checked once.
#pragma once

#include <cstddef>
#include <cstdint>

#include <strut/c/strut.h>

namespace strut::c {

/// Where a caller keeps the joints of a frame. Float is float or const float.
template <typename Float>
struct JointTransforms {
  Float* rotations;
  Float* translations;
  std::ptrdiff_t rotation_step, translation_step;  // [floats]
  int num_joints;

  [[nodiscard]] Float* rotation(int joint) const noexcept { return rotations + joint * rotation_step; }
  [[nodiscard]] Float* translation(int joint) const noexcept { return translations + joint * translation_step; }
  /// Whether joints follow each other without a gap.
  [[nodiscard]] bool is_tight() const noexcept { return rotation_step == 4 && translation_step == 3; }
};

/// The joints of a pose that came through a pointer. Throws InvalidArgument, naming `name`, if it or one of its
/// pointers is NULL or not aligned as a float, there is not one joint, or joints would overlap.
JointTransforms<const float> joints_of(const char* name, const strut_const_pose* pose);
JointTransforms<float> joints_of(const char* name, const strut_pose* pose);

/// Throws InvalidArgument, naming `name`, unless there are `expected` joints.
void check_num_joints(const char* name, int expected, int got);

}  // namespace strut::c
