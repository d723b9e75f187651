// SPDX-License-Identifier: MIT
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/motion/joint_curves.h>

namespace strut::motion {
namespace {

constexpr double kRounding = 1e-12;
constexpr int kShoulder = 1;
constexpr int kHand = 2;

std::shared_ptr<const Skeleton> arm() {
  return std::make_shared<const Skeleton>(
      std::vector<Joint>{{"root", -1, {0, 1, 0}}, {"shoulder", 0, {0, 0.5, 0}}, {"hand", kShoulder, {0.6, 0, 0}}});
}

/// The shoulder turned about Z by `step` more in every frame.
Motion turning(int frames, double step) {
  const auto skeleton = arm();
  std::vector<Pose> poses(static_cast<std::size_t>(frames), rest_pose(*skeleton));
  for (int i = 0; i < frames; ++i) {
    poses[static_cast<std::size_t>(i)].rotations[kShoulder] = Eigen::AngleAxisd(i * step, Eigen::Vector3d::UnitZ());
  }
  return {skeleton, 30.0, poses};
}

TEST(RotationCurve, DoesNotJumpAtHalfATurn) {
  const FrameMatrix curve = rotation_curve(turning(44, 0.1), kShoulder);  // up to 4.3 rad
  for (int i = 0; i < 44; ++i) EXPECT_NEAR(curve(i, 2), 0.1 * i, kRounding) << i;
  EXPECT_LT(curve.leftCols(2).cwiseAbs().maxCoeff(), kRounding);
}

TEST(RotationCurve, OfAJointThatRestsIsZero) {
  EXPECT_EQ(rotation_curve(turning(5, 0.1), kHand).cwiseAbs().maxCoeff(), 0.0);
}

TEST(PositionCurve, IsInTheWorld) {
  const FrameMatrix curve = position_curve(turning(4, 0.5), kHand);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(curve(i, 0), 0.6 * std::cos(0.5 * i), kRounding);
    EXPECT_NEAR(curve(i, 1), 1.5 + 0.6 * std::sin(0.5 * i), kRounding);
  }
}

TEST(TranslationCurve, IsInTheParentsFrame) {
  const FrameMatrix curve = translation_curve(turning(3, 0.5), kHand);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(curve.row(i), Eigen::RowVector3d(0.6, 0, 0));
}

TEST(MovesInParent, IsTrueOfAJointThatLeavesItsPlaceOnce) {
  const auto skeleton = arm();
  std::vector<Pose> poses(5, rest_pose(*skeleton));
  poses[3].translations[kHand].x() += 0.01;
  poses[3].translations[0].x() += 1.0;
  const Motion motion(skeleton, 30.0, poses);
  EXPECT_TRUE(moves_in_parent(motion, kHand));
  EXPECT_FALSE(moves_in_parent(motion, kShoulder));
  EXPECT_FALSE(moves_in_parent(motion, 0));
}

TEST(JointCurves, RefuseAJointThatIsNone) {
  const Motion motion = turning(2, 0.1);
  EXPECT_THROW(rotation_curve(motion, 3), InvalidArgument);
  EXPECT_THROW(position_curve(motion, -1), InvalidArgument);
  EXPECT_THROW(translation_curve(motion, 3), InvalidArgument);
  EXPECT_THROW(moves_in_parent(motion, 3), InvalidArgument);
}

}  // namespace
}  // namespace strut::motion
