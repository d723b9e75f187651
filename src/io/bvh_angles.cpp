// SPDX-License-Identifier: MIT
// Everything is brought to the order X, Y, Z first: an odd order of axes is an even one with vector part and angles
// negated.
#include "bvh_angles.h"

#include <cmath>
#include <numbers>

namespace strut::io::detail {
namespace {

using Angles = std::array<double, 3>;

constexpr double kPi = std::numbers::pi;
// Below this cosine of the middle angle the outer two are no longer known apart: rounding is 1e-16 / 1e-7 of an angle.
constexpr double kGimbalCosine = 1e-7;

double nearest_turn(double angle, double reference) {
  return angle + 2.0 * kPi * std::round((reference - angle) / (2.0 * kPi));
}

Angles nearest_turns(const Angles& angles, const Angles& reference) {
  Angles result = {};
  for (std::size_t i = 0; i < 3; ++i) result[i] = nearest_turn(angles[i], reference[i]);
  return result;
}

double distance(const Angles& a, const Angles& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Middle angle at +-90 degrees: only the sum (or difference) of the outer angles is known; both move alike to reach
/// it.
Angles locked_angles(const Eigen::Matrix3d& r, double middle, const Angles& reference) {
  const double sign = middle > 0.0 ? 1.0 : -1.0;
  const double combined = std::atan2(r(1, 0), r(1, 1));  // last + sign * first
  const double b = nearest_turn(middle, reference[1]);
  const double wanted = reference[2] + sign * reference[0];
  const double half = 0.5 * (nearest_turn(combined, wanted) - wanted);
  return {reference[0] + sign * half, b, reference[2] + half};
}

/// For R = Rx(a) Ry(b) Rz(c).
Angles angles_xyz_near(const Eigen::Quaterniond& rotation, const Angles& reference) {
  const Eigen::Matrix3d r = rotation.toRotationMatrix();
  const double cosine = std::hypot(r(0, 0), r(0, 1));
  const double b = std::atan2(r(0, 2), cosine);
  if (cosine < kGimbalCosine) return locked_angles(r, b, reference);
  const double a = std::atan2(-r(1, 2), r(2, 2));
  const double c = std::atan2(-r(0, 1), r(0, 0));
  const Angles first = nearest_turns({a, b, c}, reference);
  const Angles second = nearest_turns({a + kPi, kPi - b, c + kPi}, reference);
  return distance(second, reference) < distance(first, reference) ? second : first;
}

}  // namespace

std::array<double, 3> angles_near(const Eigen::Quaterniond& rotation, const std::array<int, 3>& axes,
                                  const std::array<double, 3>& reference) {
  const double parity = (axes[1] - axes[0] + 3) % 3 == 1 ? 1.0 : -1.0;
  const auto& coefficients = rotation.coeffs();  // x, y, z, w
  const Eigen::Quaterniond in_order(rotation.w(), parity * coefficients[axes[0]], parity * coefficients[axes[1]],
                                    parity * coefficients[axes[2]]);
  Angles angles = angles_xyz_near(in_order, {parity * reference[0], parity * reference[1], parity * reference[2]});
  for (double& angle : angles) angle *= parity;
  return angles;
}

}  // namespace strut::io::detail
