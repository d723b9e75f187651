// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/riccati.h>

namespace strut::sysid {
namespace {

constexpr double kExact = 1e-10;  // of numbers of size one: rounding of a few dozen products

Eigen::MatrixXd scalar(double value) {
  return Eigen::MatrixXd::Constant(1, 1, value);
}

TEST(StationaryKalmanFilter, SolvesTheScalarEquation) {
  // P = a^2 P + q - (a P)^2 / (P + r): P^2 + (r (1 - a^2) - q) P - q r = 0.
  const double a = 0.9, q = 0.5, r = 2.0;
  const double b = r * (1.0 - a * a) - q;
  const double p = 0.5 * (-b + std::sqrt(b * b + 4.0 * q * r));
  const auto filter = stationary_kalman_filter(scalar(a), scalar(1.0), {scalar(q), scalar(0.0), scalar(r)});
  ASSERT_TRUE(filter);
  EXPECT_NEAR(filter->error(0, 0), p, kExact);
  EXPECT_NEAR(filter->gain(0, 0), a * p / (p + r), kExact);
  EXPECT_NEAR(filter->innovation(0, 0), p + r, kExact);
}

/// Noise of a full covariance [Q S; S' R].
NoiseCovariances noise_of(int states, int outputs, unsigned seed) {
  std::mt19937 random(seed);
  const Eigen::MatrixXd root = test::white_noise(states + outputs, states + outputs, random);
  const Eigen::MatrixXd joint = root * root.transpose();
  return {joint.topLeftCorner(states, states), joint.topRightCorner(states, outputs),
          joint.bottomRightCorner(outputs, outputs)};
}

TEST(StationaryKalmanFilter, SatisfiesTheEquationWithCorrelatedNoise) {
  const LtiSystem system = test::known_system();
  for (const double scale : {1.0, 1.1, 1.3}) {  // 0.9 * 1.3: two modes of the plant are unstable, the filter is not
    const Eigen::MatrixXd a = scale * system.a();
    const Eigen::MatrixXd& c = system.c();
    const NoiseCovariances noise = noise_of(4, 3, 7);
    const auto filter = stationary_kalman_filter(a, c, noise);
    ASSERT_TRUE(filter);
    const Eigen::MatrixXd& p = filter->error;
    const Eigen::MatrixXd cross = a * p * c.transpose() + noise.cross;
    const Eigen::MatrixXd right = a * p * a.transpose() + noise.state -
                                  cross * (c * p * c.transpose() + noise.output).inverse() * cross.transpose();
    EXPECT_LT((right - p).norm(), kExact * p.norm());
    EXPECT_LT(LtiSystem(a - filter->gain * c, system.b(), c, system.d()).spectral_radius(), 1.0);
  }
}

TEST(StationaryKalmanFilter, IsNoneWhereTheEquationHasNoSolution) {
  const NoiseCovariances none{scalar(0.0), scalar(0.0), scalar(1.0)};
  EXPECT_FALSE(stationary_kalman_filter(scalar(1.0), scalar(1.0), none))
      << "a mode on the circle that no noise reaches";
  EXPECT_FALSE(stationary_kalman_filter(scalar(1.5), scalar(0.0), {scalar(1.0), scalar(0.0), scalar(1.0)}))
      << "an unstable mode that the output does not show";
  EXPECT_FALSE(stationary_kalman_filter(scalar(0.5), scalar(1.0), {scalar(1.0), scalar(0.0), scalar(0.0)}));
  EXPECT_FALSE(stationary_kalman_filter(scalar(0.5), scalar(1.0), {scalar(1.0), scalar(0.0), scalar(-1.0)}));
}

TEST(StationaryKalmanFilter, OfNoStatesHasTheOutputsNoise) {
  const auto filter = stationary_kalman_filter(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(2, 0), noise_of(0, 2, 3));
  ASSERT_TRUE(filter);
  EXPECT_EQ(filter->gain.size(), 0);
  EXPECT_EQ(filter->innovation, noise_of(0, 2, 3).output);
}

TEST(StationaryKalmanFilter, RefusesShapesThatDoNotAgree) {
  EXPECT_THROW(stationary_kalman_filter(scalar(1.0), Eigen::MatrixXd::Zero(1, 2), noise_of(1, 1, 1)), InvalidArgument);
  EXPECT_THROW(stationary_kalman_filter(scalar(1.0), scalar(1.0), noise_of(2, 1, 1)), InvalidArgument);
  EXPECT_THROW(stationary_kalman_filter(scalar(std::nan("")), scalar(1.0), noise_of(1, 1, 1)), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
