// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/math/rotation.h>

namespace strut::math {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;  // a few roundings of numbers of size one

double unit_interval() {
  return static_cast<double>(*rc::gen::inRange(-1000000, 1000001)) / 1e6;
}

Eigen::Vector3d random_vector(double size) {
  return size * Eigen::Vector3d(unit_interval(), unit_interval(), unit_interval());
}

TEST(ExpMap, OfAQuarterTurnAboutZ) {
  const auto q = exp_map({0, 0, kPi / 2});
  EXPECT_NEAR(q.w(), std::sqrt(0.5), kRounding);
  EXPECT_NEAR(q.z(), std::sqrt(0.5), kRounding);
}

TEST(ExpMap, OfTinyVectorsKeepsEveryDigit) {
  for (const double size : {0.0, 1e-300, 1e-12, 1e-5, 1e-4, 1e-3}) {
    const Eigen::Vector3d v(size, 0, 0);
    EXPECT_NEAR(log_map(exp_map(v)).x(), size, 1e-15 * size) << size;
  }
}

RC_GTEST_PROP(ExpMap, IsUndoneByTheLogMapUpToHalfATurn, ()) {
  Eigen::Vector3d v = random_vector(3.0);
  if (v.norm() > 3.1) v *= 3.1 / v.norm();
  RC_ASSERT((log_map(exp_map(v)) - v).norm() < 1e-13);
}

TEST(MeanRotation, IgnoresTheSignOfQuaternions) {
  Eigen::Quaterniond q = exp_map({0.3, -0.2, 0.9});
  Eigen::Quaterniond minus = q;
  minus.coeffs() = -minus.coeffs();
  EXPECT_NEAR(mean_rotation({q, minus, q}).angularDistance(q), 0.0, 1e-7);
}

TEST(MeanRotation, LiesHalfwayBetweenTwo) {
  const auto mean = mean_rotation({exp_map({0.2, 0, 0}), exp_map({0.6, 0, 0})});
  EXPECT_NEAR(log_map(mean).x(), 0.4, 1e-12);
}

TEST(MeanRotation, OfNothingIsRefused) {
  EXPECT_THROW(mean_rotation({}), InvalidArgument);
}

RC_GTEST_PROP(Heading, TurnsWithTheBody, ()) {
  const Eigen::Quaterniond tilted = exp_map(random_vector(0.8));
  const double turn = 3.0 * unit_interval();
  RC_ASSERT(std::abs(wrap_angle(heading(rotation_about_y(turn) * tilted) - heading(tilted) - turn)) < 1e-12);
}

TEST(WrapAngle, StaysInItsInterval) {
  EXPECT_NEAR(wrap_angle(3 * kPi), kPi, kRounding);
  EXPECT_NEAR(wrap_angle(-3 * kPi), kPi, kRounding);
  EXPECT_NEAR(wrap_angle(2 * kPi + 0.25), 0.25, kRounding);
}

}  // namespace
}  // namespace strut::math
