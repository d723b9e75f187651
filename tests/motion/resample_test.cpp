// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/motion/resample.h>

namespace strut::motion {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kTurning = 0.7;  // [rad/s]
constexpr double kSpeed = 1.3;    // [m/s]

/// One joint that turns about y and walks along x, both evenly: interpolation then is exact.
Motion even_motion(double frame_rate, int num_frames) {
  const auto skeleton = std::make_shared<const Skeleton>(std::vector<Joint>(1));
  std::vector<Pose> frames;
  for (int t = 0; t < num_frames; ++t) {
    const double time = t / frame_rate;
    frames.push_back({{math::rotation_about_y(kTurning * time)}, {Eigen::Vector3d(kSpeed * time, 0.0, 0.0)}});
  }
  return {skeleton, frame_rate, frames};
}

double error_at(const Pose& pose, double time) {
  return (pose.translations[0] - Eigen::Vector3d(kSpeed * time, 0.0, 0.0)).norm() +
         pose.rotations[0].angularDistance(math::rotation_about_y(kTurning * time));
}

TEST(Interpolate, GoesTheShorterWayRound) {
  Pose a{{math::rotation_about_y(0.2)}, {Eigen::Vector3d::Zero()}};
  Pose b{{math::rotation_about_y(0.6)}, {Eigen::Vector3d(0.0, 2.0, 0.0)}};
  b.rotations[0].coeffs() *= -1.0;  // the same rotation, written the other way
  const Pose middle = interpolate(a, b, 0.5);
  EXPECT_NEAR(middle.rotations[0].angularDistance(math::rotation_about_y(0.4)), 0.0, 1e-7);
  EXPECT_EQ(middle.translations[0], Eigen::Vector3d(0.0, 1.0, 0.0));
}

RC_GTEST_PROP(Sample, IsExactOnEvenMotion, ()) {
  const Motion motion = even_motion(30.0, 61);
  const double time = static_cast<double>(*rc::gen::inRange(0, 200001)) / 1e5;
  RC_ASSERT(error_at(sample(motion, time), time) < 1e-7);  // angularDistance loses half the digits
}

TEST(Sample, GivesTheFramesThemselvesAtTheirTimes) {
  const Motion motion = even_motion(30.0, 10);
  for (int t = 0; t < 10; ++t) EXPECT_EQ(sample(motion, t / 30.0), motion.frame(t)) << t;
}

TEST(Sample, StopsAtTheEnds) {
  const Motion motion = even_motion(30.0, 10);
  EXPECT_EQ(sample(motion, -1.0), motion.frame(0));
  EXPECT_EQ(sample(motion, 100.0), motion.frame(9));
}

TEST(Sample, RefusesAnEmptyMotionAndTimesThatAreNone) {
  EXPECT_THROW(sample(even_motion(30.0, 0), 0.0), InvalidArgument);
  EXPECT_THROW(sample(even_motion(30.0, 3), std::nan("")), InvalidArgument);
}

TEST(Resample, KeepsTheFirstFrameAndEndsAtOrBeforeTheLast) {
  const Motion motion = even_motion(30.0, 31);  // one second
  const Motion faster = resample(motion, 100.0);
  EXPECT_EQ(faster.num_frames(), 101);
  EXPECT_EQ(faster.frame_rate(), 100.0);
  EXPECT_EQ(faster.frame(0), motion.frame(0));
  EXPECT_EQ(faster.frame(100), motion.frame(30));
  const Motion slower = resample(motion, 7.0);
  EXPECT_EQ(slower.num_frames(), 8);
  EXPECT_LT(error_at(slower.frame(5), 5 / 7.0), 1e-7);
}

TEST(Resample, ThereAndBackIsTheIdentityOnEvenMotion) {
  const Motion motion = even_motion(30.0, 31);
  const Motion back = resample(resample(motion, 120.0), 30.0);
  ASSERT_EQ(back.num_frames(), motion.num_frames());
  for (int t = 0; t < motion.num_frames(); ++t) {
    EXPECT_LT((back.frame(t).translations[0] - motion.frame(t).translations[0]).norm(), kRounding);
    EXPECT_LT((back.frame(t).rotations[0].coeffs() - motion.frame(t).rotations[0].coeffs()).norm(), kRounding);
  }
}

TEST(Resample, AtTheSameRateChangesNothing) {
  const Motion motion = even_motion(30.0, 12);
  EXPECT_EQ(resample(motion, 30.0).frames(), motion.frames());
}

TEST(Resample, OfAnEmptyMotionIsEmpty) {
  const Motion empty = resample(even_motion(30.0, 0), 60.0);
  EXPECT_EQ(empty.num_frames(), 0);
  EXPECT_EQ(empty.frame_rate(), 60.0);
}

TEST(Resample, RefusesRatesThatAreNone) {
  for (const double rate : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(resample(even_motion(30.0, 3), rate), InvalidArgument) << rate;
  }
}

}  // namespace
}  // namespace strut::motion
