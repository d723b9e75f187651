// SPDX-License-Identifier: MIT
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::motion {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kRounding = 1e-13;  // a few roundings of lengths below ten metres

/// An upper and a lower bone of one metre, along x from the root on.
std::shared_ptr<const Skeleton> arm() {
  std::vector<Joint> joints(3);
  joints[0].name = "shoulder";
  joints[1] = {.name = "elbow", .parent = 0, .offset = {1.0, 0.0, 0.0}};
  joints[2] = {.name = "wrist", .parent = 1, .offset = {1.0, 0.0, 0.0}};
  return std::make_shared<const Skeleton>(joints);
}

double near_one() {
  return static_cast<double>(*rc::gen::inRange(-1000, 1001)) / 1e3;
}

Eigen::Vector3d random_vector() {
  return {near_one(), near_one(), near_one()};
}

Pose random_pose(const Skeleton& skeleton) {
  Pose pose = rest_pose(skeleton);
  for (auto& rotation : pose.rotations) rotation = math::exp_map(2.0 * random_vector());
  for (auto& translation : pose.translations) translation += random_vector();
  return pose;
}

TEST(ForwardKinematics, OfTheRestPoseAddsTheOffsets) {
  const auto skeleton = arm();
  const WorldPose world = forward_kinematics(*skeleton, rest_pose(*skeleton));
  EXPECT_EQ(world.positions[2], Eigen::Vector3d(2.0, 0.0, 0.0));
  EXPECT_EQ(world.rotations[2].coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(ForwardKinematics, TurnsWhatHangsBelow) {
  const auto skeleton = arm();
  Pose pose = rest_pose(*skeleton);
  pose.translations[0] = {0.0, 1.0, 0.0};
  pose.rotations[0] = math::exp_map({0.0, 0.0, kQuarter});  // the upper arm points up
  pose.rotations[1] = math::exp_map({kQuarter, 0.0, 0.0});  // about the arm itself: nothing moves
  WorldPose world = forward_kinematics(*skeleton, pose);
  EXPECT_LT((world.positions[2] - Eigen::Vector3d(0.0, 3.0, 0.0)).norm(), kRounding);
  pose.rotations[1] = math::exp_map({0.0, 0.0, kQuarter});  // the forearm points backwards
  forward_kinematics(*skeleton, pose, world);
  EXPECT_LT((world.positions[2] - Eigen::Vector3d(-1.0, 2.0, 0.0)).norm(), kRounding);
}

RC_GTEST_PROP(ForwardKinematics, AgreesWithMultiplyingMatrices, ()) {
  const auto skeleton = arm();
  const Pose pose = random_pose(*skeleton);
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  const WorldPose world = forward_kinematics(*skeleton, pose);
  for (std::size_t j = 0; j < 3; ++j) {  // the arm is a chain
    transform = transform * Eigen::Translation3d(pose.translations[j]) * pose.rotations[j];
    RC_ASSERT((world.positions[j] - transform.translation()).norm() < kRounding);
    RC_ASSERT((world.rotations[j].toRotationMatrix() - transform.linear()).norm() < kRounding);
  }
}

TEST(JointPositionsWorld, HoldsEveryFrame) {
  const auto skeleton = arm();
  Pose second = rest_pose(*skeleton);
  second.translations[0].z() = 5.0;
  const auto positions = joint_positions_world({skeleton, 30.0, {rest_pose(*skeleton), second}});
  ASSERT_EQ(positions.size(), 2U);
  EXPECT_EQ(positions[0][1], Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(positions[1][1], Eigen::Vector3d(1.0, 0.0, 5.0));
}

RC_GTEST_PROP(Moved, TurnsAndShiftsEveryJointAlike, ()) {
  const auto skeleton = arm();
  const Motion motion(skeleton, 30.0, {random_pose(*skeleton)});
  const Eigen::Vector3d shift = random_vector();
  const double angle = 3.0 * near_one();
  const auto before = joint_positions_world(motion)[0];
  const auto after = joint_positions_world(moved(motion, shift, angle))[0];
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitY());
  for (std::size_t j = 0; j < before.size(); ++j) RC_ASSERT((turn * before[j] + shift - after[j]).norm() < kRounding);
}

}  // namespace
}  // namespace strut::motion
