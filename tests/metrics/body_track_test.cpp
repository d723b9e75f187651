// SPDX-License-Identifier: MIT
#include "metrics/test_body.h"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/metrics/body_track.h>
#include <strut/motion/kinematics.h>

namespace strut::metrics {
namespace {

using test::test_motion;

constexpr double kRounding = 1e-12;  // a few roundings of metres

TEST(BodyTrack, HoldsPositionsFromTheGroundBelowTheHips) {
  const BodyTrack track = body_track(motion::moved(test_motion(2, 30.0), {3.0, 0.0, -2.0}, 0.0), 30.0);
  ASSERT_EQ(track.num_joints(), test::kNumJoints);
  const Eigen::RowVector3d hand = track.positions_heading.block<1, 3>(1, 3 * test::kHandL);
  EXPECT_LT((hand - Eigen::RowVector3d(0.7, 1.4, 0.0)).norm(), kRounding);
  EXPECT_LT((track.hips_world.row(0) - Eigen::RowVector3d(3.0, 0.95, -2.0)).norm(), kRounding);
  EXPECT_NEAR(track.heading[0], 0.0, kRounding);
}

RC_GTEST_PROP(BodyTrack, PosesStayWhenTheClipIsMovedAndTurned, ()) {
  const double angle = *rc::gen::inRange(-3000, 3000) / 1000.0;
  const Motion still = test_motion(3, 30.0, [](Pose& pose, double t) { pose.translations[test::kHandL].z() += t; });
  const BodyTrack a = body_track(still, 30.0);
  const BodyTrack b = body_track(motion::moved(still, {1.0, 0.0, 2.0}, angle), 30.0);
  RC_ASSERT((a.positions_heading - b.positions_heading).cwiseAbs().maxCoeff() < kRounding);
  RC_ASSERT(std::abs(b.heading[2] - angle) < kRounding);
}

TEST(BodyTrack, HeadingIsContinuousThroughFullTurns) {
  const Motion spin = test_motion(
      61, 30.0, [](Pose& pose, double t) { pose.rotations[0] = Eigen::AngleAxisd(6.0 * t, Eigen::Vector3d::UnitY()); });
  EXPECT_NEAR(body_track(spin, 30.0).heading[60], 12.0, 1e-9);
}

TEST(BodyTrack, LeavesOutWhatCarriesThePelvis) {
  std::vector<Joint> joints = test::test_skeleton()->joints();
  for (Joint& joint : joints) ++joint.parent;
  joints.insert(joints.begin(), Joint{"carrier", -1, {0, 0, 0}});
  const auto skeleton = std::make_shared<const Skeleton>(joints);
  const BodyTrack track = body_track({skeleton, 30.0, {rest_pose(*skeleton)}}, 30.0);
  EXPECT_EQ(track.num_joints(), test::kNumJoints);
  EXPECT_EQ(track.joints.front(), 1);
}

TEST(BodyTrack, PlacesAreToldInFramesOfTheGivenClip) {
  const BodyTrack track = body_track(test_motion(121, 120.0), 30.0);
  EXPECT_EQ(track.num_frames(), 31);
  const Place place = track.place(test::kHead, 10.0);
  EXPECT_EQ(place.frame, 40);
  EXPECT_NEAR(place.time, 1.0 / 3.0, kRounding);
}

TEST(BodyTrack, OfNothingIsRefused) {
  EXPECT_THROW(body_track(test_motion(0, 30.0), 30.0), InvalidArgument);
}

TEST(MeasuringRate, TakesEveryNthFrame) {
  EXPECT_DOUBLE_EQ(measuring_rate(30.0), 30.0);
  EXPECT_DOUBLE_EQ(measuring_rate(120.0), 30.0);
  EXPECT_DOUBLE_EQ(measuring_rate(100.0), 100.0 / 3.0);
  EXPECT_DOUBLE_EQ(measuring_rate(24.0), 24.0);
  EXPECT_DOUBLE_EQ(measuring_rate(10.0), 10.0);
}

}  // namespace
}  // namespace strut::metrics
