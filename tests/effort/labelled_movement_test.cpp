// SPDX-License-Identifier: MIT
// What raters see of a fragment or a blend.
#include "effort/small_database.h"

#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/labelled_movement.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>

namespace strut::test {
namespace {

using namespace effort;

constexpr double kRounding = 1e-6;  // m and rad: rotations are kept to 4e-7

using LabelledMovement = FragmentDatabaseTest;

/// The movement turned and moved on the ground.
Motion elsewhere(const Motion& motion) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY()));
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    pose.rotations[0] = turn * pose.rotations[0];
    pose.translations[0] = turn * pose.translations[0] + Eigen::Vector3d(3.0, 0.0, -5.0);
  }
  return {motion.shared_skeleton(), motion.frame_rate(), std::move(frames)};
}

double farthest_apart(const Motion& a, const Motion& b) {
  double farthest = 0.0;
  motion::WorldPose one, other;
  for (int t = 0; t < a.num_frames(); ++t) {
    motion::forward_kinematics(a.skeleton(), a.frame(t), one);
    motion::forward_kinematics(b.skeleton(), b.frame(t), other);
    for (std::size_t j = 0; j < one.positions.size(); ++j) {
      farthest = std::max(farthest, (one.positions[j] - other.positions[j]).norm());
    }
  }
  return farthest;
}

TEST_F(LabelledMovement, IsTheFragmentAloneAtTheOrigin) {
  const FragmentDatabase database = filled();
  const Motion shown = labelled_movement(database, {TargetKind::kFragment, 2});
  ASSERT_EQ(shown.num_frames(), 30);
  motion::WorldPose world;
  motion::forward_kinematics(shown.skeleton(), shown.frame(0), world);
  const Eigen::Vector3d pelvis = world.positions[static_cast<std::size_t>(shown.skeleton().pelvis())];
  EXPECT_NEAR(pelvis.x(), 0.0, kRounding);
  EXPECT_NEAR(pelvis.z(), 0.0, kRounding);
  const auto legs = motion::find_legs(shown);
  ASSERT_TRUE(legs);
  double facing = 0.0;
  for (const Pose& pose : shown.frames()) {
    motion::forward_kinematics(shown.skeleton(), pose, world);
    facing += motion::facing(*legs, world) / shown.num_frames();
  }
  EXPECT_NEAR(facing, 0.0, 0.05);  // rad: the pelvis's heading and the hips' differ by a little
}

TEST_F(LabelledMovement, TellsNothingOfPlaceAndDirection) {
  FragmentDatabase database = filled();
  database.add_clip({"c.bvh", "", ""}, elsewhere(walk_), {{0, 20}});
  const Motion here = labelled_movement(database, {TargetKind::kFragment, 1});
  const Motion there = labelled_movement(database, {TargetKind::kFragment, 7});
  EXPECT_LT(farthest_apart(here, there), kRounding);
}

TEST_F(LabelledMovement, BlendsWhatIsABlend) {
  FragmentDatabase database = filled();
  const RecordId blend = database.add_blend(2, 5, 0.5);
  const Motion shown = labelled_movement(database, {TargetKind::kBlend, blend});
  EXPECT_NEAR(shown.num_frames(), 30, 3);
  EXPECT_GT(farthest_apart(shown.slice(0, 20), labelled_movement(database, {TargetKind::kFragment, 2}).slice(0, 20)),
            0.001);
}

TEST_F(LabelledMovement, RefusesWhatIsNotThere) {
  const FragmentDatabase database = filled();
  EXPECT_THROW(labelled_movement(database, {TargetKind::kFragment, 99}), InvalidArgument);
  EXPECT_THROW(labelled_movement(database, {TargetKind::kBlend, 1}), InvalidArgument);
}

}  // namespace
}  // namespace strut::test
