// SPDX-License-Identifier: MIT
// What a frame must be before a translator changes anything for it.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/motion/pose_view.h>

namespace strut::translate {

// Translations farther than this [m] are no body's; what follows from nearer ones is a number in single precision.
inline constexpr double kFarthestTranslation = 1e7;

inline void check_num_joints(const char* name, int got, int expected) {
  if (got != expected) throw InvalidArgument(name, std::to_string(expected) + " joints", std::to_string(got));
}

/// Throws InvalidArgument unless `pose` has `num_joints`, its rotations are of unit length (within 1e-3) and its
/// translations finite and less than kFarthestTranslation. `character` is named if it is not negative.
template <typename Scalar>
void check_pose(const PoseView<const Scalar>& pose, int num_joints, int character = -1) {
  check_num_joints("input", pose.num_joints, num_joints);
  constexpr auto kUnitLengthTolerance = Scalar(1e-3);  // rounding is a thousand times less; a wrong order is far off
  constexpr auto kFarthest = static_cast<Scalar>(kFarthestTranslation);
  const auto is_unit = [](const Scalar* q) {
    return std::abs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - Scalar(1)) < kUnitLengthTolerance;
  };
  bool is_good = true;  // comparisons with NaN are false
  for (int j = 0; j < num_joints; ++j) is_good &= is_unit(pose.rotations + 4 * j);
  for (int i = 0; i < 3 * num_joints; ++i) is_good &= std::abs(pose.translations[i]) < kFarthest;
  for (int j = 0; !is_good && j < num_joints; ++j) {
    const Scalar* t = pose.translations + 3 * j;
    const bool is_near = std::abs(t[0]) < kFarthest && std::abs(t[1]) < kFarthest && std::abs(t[2]) < kFarthest;
    if (is_unit(pose.rotations + 4 * j) && is_near) continue;
    const std::string whose = character < 0 ? "" : " of character " + std::to_string(character);
    throw InvalidArgument("input", "unit rotations and translations of less than 10,000 km",
                          "others at joint " + std::to_string(j) + whose);
  }
}

}  // namespace strut::translate
