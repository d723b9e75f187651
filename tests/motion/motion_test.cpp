// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/motion/motion.h>

namespace strut {
namespace {

std::shared_ptr<const Skeleton> stick() {
  std::vector<Joint> joints(2);
  joints[0].name = "foot";
  joints[1] = {.name = "top", .parent = 0, .offset = {0.0, 1.0, 0.0}};
  return std::make_shared<const Skeleton>(joints);
}

/// `count` frames of which each stands further along z.
std::vector<Pose> walking(int count) {
  std::vector<Pose> frames(static_cast<std::size_t>(count), rest_pose(*stick()));
  for (int t = 0; t < count; ++t) frames[static_cast<std::size_t>(t)].translations[0].z() = t;
  return frames;
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

TEST(RestPose, HoldsTheOffsets) {
  const Pose pose = rest_pose(*stick());
  EXPECT_EQ(pose.translations[1], Eigen::Vector3d(0.0, 1.0, 0.0));
  EXPECT_EQ(pose.rotations[1].coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(Motion, KnowsItsTimes) {
  const Motion motion(stick(), 25.0, walking(50));
  EXPECT_EQ(motion.num_frames(), 50);
  EXPECT_EQ(motion.frame_time(), 0.04);
  EXPECT_EQ(motion.duration(), 2.0);
  EXPECT_EQ(motion.frame(7).translations[0].z(), 7.0);
}

TEST(Motion, MayBeEmpty) {
  EXPECT_EQ(Motion(stick(), 30.0).num_frames(), 0);
}

TEST(Motion, NormalizesRotationsThatAreNearlyUnit) {
  auto frames = walking(1);
  frames[0].rotations[1].coeffs() *= 1.0 + 5e-7;
  EXPECT_NEAR(Motion(stick(), 30.0, frames).frame(0).rotations[1].norm(), 1.0, 1e-15);
}

TEST(Motion, RefusesANullSkeletonAndRatesThatAreNone) {
  EXPECT_EQ(message_of([] { Motion(nullptr, 30.0); }), "skeleton: expected a skeleton, got null");
  for (const double rate : {0.0, -30.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(Motion(stick(), rate), InvalidArgument) << rate;
  }
}

TEST(Motion, RefusesPosesThatDoNotFit) {
  auto frames = walking(2);
  frames[1].translations.pop_back();
  EXPECT_EQ(message_of([&] { Motion(stick(), 30.0, frames); }),
            "frames[1]: expected 2 joints, got 2 rotations and 1 translations");
}

TEST(Motion, RefusesNumbersThatAreNone) {
  auto frames = walking(3);
  frames[2].translations[1].x() = std::nan("");
  EXPECT_EQ(message_of([&] { Motion(stick(), 30.0, frames); }),
            "frames[2]: expected finite numbers, got NaN or infinity at joint 1");
  frames = walking(3);
  frames[0].rotations[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message_of([&] { Motion(stick(), 30.0, frames); }),
            "frames[0]: expected finite numbers, got NaN or infinity at joint 0");
}

TEST(Motion, RefusesRotationsThatAreNotUnit) {
  auto frames = walking(1);
  frames[0].rotations[1].coeffs() *= 2.0;
  EXPECT_EQ(message_of([&] { Motion(stick(), 30.0, frames); }),
            "frames[0]: expected unit rotations, got one of length 2.000000 at joint 1");
}

TEST(MotionSlice, HoldsTheFramesAskedFor) {
  const Motion motion(stick(), 30.0, walking(10));
  const Motion part = motion.slice(3, 6);
  EXPECT_EQ(part.num_frames(), 3);
  EXPECT_EQ(part.frame(0), motion.frame(3));
  EXPECT_EQ(part.frame(2), motion.frame(5));
  EXPECT_EQ(part.shared_skeleton(), motion.shared_skeleton());
  EXPECT_EQ(motion.slice(4, 4).num_frames(), 0);
}

TEST(MotionSlice, RefusesRangesOutsideTheMotion) {
  const Motion motion(stick(), 30.0, walking(10));
  EXPECT_EQ(message_of([&] { (void)motion.slice(-1, 3); }), "frames: expected a range inside 0 to 10, got -1 to 3");
  EXPECT_THROW((void)motion.slice(5, 4), InvalidArgument);
  EXPECT_THROW((void)motion.slice(0, 11), InvalidArgument);
}

}  // namespace
}  // namespace strut
