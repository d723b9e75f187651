// SPDX-License-Identifier: MIT
// Exponential and logarithm maps of rotations, and what is built on them. Quaternions are Hamilton, unit, written
// (w, x, y, z); a rotation vector is axis times angle [rad].
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace strut::math {

/// exp: rotation vector [rad] -> unit quaternion. Exact to rounding for every length, zero included. (Grassia 1998)
Eigen::Quaterniond exp_map(const Eigen::Vector3d& rotation_vector);

/// log: unit quaternion -> rotation vector [rad] of length at most pi (the shorter way round).
Eigen::Vector3d log_map(const Eigen::Quaterniond& rotation);

/// The rotation that minimizes the sum of squared quaternion distances to `rotations` (signs ignored): the dominant
/// eigenvector of sum q q^T (Markley et al. 2007). Throws InvalidArgument if empty. Cost O(n).
Eigen::Quaterniond mean_rotation(const std::vector<Eigen::Quaterniond>& rotations);

/// The heading of `rotation`: the angle [rad], in (-pi, pi], of its twist about the vertical axis Y. Turning the
/// rotation about Y by an angle adds that angle. Undefined (0) for an exact half turn about a horizontal axis.
double heading(const Eigen::Quaterniond& rotation);

/// The rotation by `angle` [rad] about the vertical axis Y.
Eigen::Quaterniond rotation_about_y(double angle);

/// `angle` [rad] brought into (-pi, pi].
double wrap_angle(double angle);

}  // namespace strut::math
