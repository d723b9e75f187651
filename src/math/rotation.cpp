// SPDX-License-Identifier: MIT
// Exponential and logarithm maps. Near zero both use the series, so no digit is lost to cancellation.
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/math/rotation.h>

namespace strut::math {
namespace {

constexpr double kPi = std::numbers::pi;

// Below this half angle, sin(x)/x = 1 - x^2/6 is exact to double rounding (the next term is x^4/120 < 1e-18).
constexpr double kSmall = 1e-4;

}  // namespace

Eigen::Quaterniond exp_map(const Eigen::Vector3d& rotation_vector) {
  const double half = 0.5 * rotation_vector.norm();
  const double sinc = half < kSmall ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  const Eigen::Vector3d xyz = 0.5 * sinc * rotation_vector;
  return {std::cos(half), xyz.x(), xyz.y(), xyz.z()};
}

Eigen::Vector3d log_map(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d xyz = sign * rotation.vec();
  const double sine = xyz.norm();
  const double cosine = sign * rotation.w();
  if (sine < kSmall) return 2.0 * (1.0 + sine * sine / 6.0) * xyz / (sine * sine + cosine * cosine);
  return (2.0 * std::atan2(sine, cosine) / sine) * xyz;
}

Eigen::Quaterniond mean_rotation(const std::vector<Eigen::Quaterniond>& rotations) {
  if (rotations.empty()) throw InvalidArgument("rotations", "at least one rotation", "none");
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const auto& q : rotations) sum += q.coeffs() * q.coeffs().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
  Eigen::Quaterniond mean;
  mean.coeffs() = solver.eigenvectors().col(3);
  if (mean.w() < 0.0) mean.coeffs() = -mean.coeffs();
  return mean.normalized();
}

double heading(const Eigen::Quaterniond& rotation) {
  if (rotation.w() == 0.0 && rotation.y() == 0.0) return 0.0;
  return wrap_angle(2.0 * std::atan2(rotation.y(), rotation.w()));
}

Eigen::Quaterniond rotation_about_y(double angle) {
  return {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0};
}

double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace strut::math
