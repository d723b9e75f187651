// SPDX-License-Identifier: MIT
// Rotations to the three angles of a BVH row. Two triples (and all multiples of a full turn) mean the same rotation,
// and at gimbal lock a whole line of them: the one nearest to a reference is taken, so that curves stay continuous.
#pragma once

#include <array>

#include <Eigen/Geometry>

namespace strut::io::detail {

/// The angles [rad] of intrinsic turns about `axes` (a permutation of the three) that make `rotation`, as near to
/// `reference` [rad] as can be.
std::array<double, 3> angles_near(const Eigen::Quaterniond& rotation, const std::array<int, 3>& axes,
                                  const std::array<double, 3>& reference);

}  // namespace strut::io::detail
