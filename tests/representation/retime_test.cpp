// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/representation/retime.h>

namespace strut::representation {
namespace {

FrameMatrix ramp(int frames) {
  FrameMatrix rows(frames, 1);
  for (int t = 0; t < frames; ++t) rows(t, 0) = t;
  return rows;
}

TEST(Retime, WithoutAWarpChangesNothing) {
  EXPECT_EQ(retime(ramp(20), Eigen::VectorXd::Zero(20)), ramp(20));
}

TEST(Retime, TwiceAsLongHasTwiceTheFrames) {
  const FrameMatrix slow = retime(ramp(11), Eigen::VectorXd::Constant(11, std::log(2.0)));
  ASSERT_EQ(slow.rows(), 21);
  for (int k = 0; k < 21; ++k) EXPECT_NEAR(slow(k, 0), 0.5 * k, 1e-12) << k;
}

TEST(Retime, FollowsAWarpThatChanges) {
  Eigen::VectorXd warp = Eigen::VectorXd::Zero(10);
  warp.tail(5).setConstant(std::log(3.0));
  const FrameMatrix rows = retime(ramp(10), warp);
  // Centres: 0 1 2 3 4, then 4 + (1 + 3) / 2 = 6, 9, 12, 15, 18.
  ASSERT_EQ(rows.rows(), 19);
  EXPECT_NEAR(rows(6, 0), 5.0, 1e-12);
  EXPECT_NEAR(rows(18, 0), 9.0, 1e-12);
}

TEST(Retime, RefusesWhatMakesNoSense) {
  EXPECT_THROW(retime(ramp(3), Eigen::VectorXd::Zero(4)), InvalidArgument);
  EXPECT_THROW(retime(FrameMatrix(0, 1), Eigen::VectorXd(0)), InvalidArgument);
  EXPECT_THROW(retime(ramp(2), Eigen::VectorXd::Constant(2, NAN)), InvalidArgument);
}

}  // namespace
}  // namespace strut::representation
