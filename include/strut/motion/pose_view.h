// SPDX-License-Identifier: MIT
// One frame as plain numbers: what the runtime reads and writes, in float or double, wherever an engine keeps it.
#pragma once

#include <algorithm>
#include <type_traits>

#include <strut/motion/motion.h>

namespace strut {

/// Every joint's transform in its parent's frame (the root's: in the world), as in Pose. Scalar is float or double,
/// const where the frame is only read.
template <typename Scalar>
struct PoseView {
  Scalar* rotations = nullptr;     ///< unit quaternions x, y, z, w (num_joints x 4)
  Scalar* translations = nullptr;  ///< [m] (num_joints x 3)
  int num_joints = 0;

  /// The same to be read only.
  operator PoseView<const Scalar>() const noexcept  // NOLINT(google-explicit-constructor): as a pointer converts
      requires(!std::is_const_v<Scalar>) {
    return {rotations, translations, num_joints};
  }
};

/// A pose as a view of it.
inline PoseView<const double> view(const Pose& pose) noexcept {
  static_assert(sizeof(Eigen::Quaterniond) == 4 * sizeof(double) && sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  if (pose.rotations.empty()) return {};
  return {pose.rotations.front().coeffs().data(), pose.translations.front().data(),
          static_cast<int>(pose.rotations.size())};
}

/// A pose as a view to write to. `pose` must have its size.
inline PoseView<double> view(Pose& pose) noexcept {
  if (pose.rotations.empty()) return {};
  return {pose.rotations.front().coeffs().data(), pose.translations.front().data(),
          static_cast<int>(pose.rotations.size())};
}

/// Writes the numbers of one pose to another of as many joints, which may be of the other precision.
template <typename From, typename To>
void copy_pose(const PoseView<From>& from, const PoseView<To>& to) {
  const auto convert = [](auto number) { return static_cast<To>(number); };
  std::transform(from.rotations, from.rotations + 4 * from.num_joints, to.rotations, convert);
  std::transform(from.translations, from.translations + 3 * from.num_joints, to.translations, convert);
}

}  // namespace strut
