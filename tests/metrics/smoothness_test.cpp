// SPDX-License-Identifier: MIT
#include "metrics/test_body.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/metrics/smoothness.h>

namespace strut::metrics {
namespace {

using test::test_motion;

constexpr double kRounding = 1e-7;  // third differences of metres, times 27000

TEST(Smoothness, OfACubicIsItsThirdDerivative) {
  const auto reach = [](Pose& pose, double t) { pose.translations[test::kHandL].z() += 2.0 * t * t * t; };
  const Smoothness found = smoothness(test_motion(40, 30.0, reach));
  EXPECT_NEAR(found.jerk, 12.0 / (3.0 * test::kNumJoints), kRounding);
  EXPECT_NEAR(found.worst_jerk, 12.0, kRounding);
  EXPECT_EQ(found.worst.joint, test::kHandL);
}

TEST(Smoothness, IsTheSameAtFourTimesTheRate) {
  const auto reach = [](Pose& pose, double t) { pose.translations[test::kHandL].z() += 2.0 * t * t * t; };
  EXPECT_NEAR(smoothness(test_motion(160, 120.0, reach)).jerk, smoothness(test_motion(40, 30.0, reach)).jerk,
              kRounding);
}

TEST(Smoothness, IgnoresTravelAndTurning) {
  const auto carousel = [](Pose& pose, double t) {
    pose.rotations[0] = Eigen::AngleAxisd(2.0 * t, Eigen::Vector3d::UnitY());
    pose.translations[0].z() += 3.0 * t * t * t;
  };
  EXPECT_NEAR(smoothness(test_motion(60, 30.0, carousel)).jerk, 0.0, kRounding);
}

TEST(Smoothness, FindsTheFrameThatPops) {
  const auto pop = [](Pose& pose, double t) {
    if (t == 101.0 / 120.0) pose.translations[test::kHead].x() += 0.05;
  };
  const Smoothness found = smoothness(test_motion(240, 120.0, pop));
  EXPECT_NEAR(found.pop, 0.05, kRounding);
  EXPECT_EQ(found.worst_pop.joint, test::kHead);
  EXPECT_EQ(found.worst_pop.frame, 101);
  EXPECT_NEAR(found.jerk, 0.0, kRounding);  // between the frames that jerk is measured at
}

TEST(Smoothness, NeedsFourFrames) {
  EXPECT_NO_THROW(smoothness(test_motion(4, 30.0)));
  EXPECT_THROW(smoothness(test_motion(3, 30.0)), InvalidArgument);
}

}  // namespace
}  // namespace strut::metrics
