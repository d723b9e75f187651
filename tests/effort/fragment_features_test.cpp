// SPDX-License-Identifier: MIT
#include "effort/real_clips.h"
#include "support/walks.h"

#include <random>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/fragment_features.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>

namespace strut::effort {
namespace {

constexpr double kRounding = 1e-12;  // metres, at most ten metres from the origin

FrameMatrix noise(int frames, int features, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return FrameMatrix::NullaryExpr(frames, features, [&] { return normal(generator); });
}

TEST(JointFeatures, StayWhenTheClipIsMovedAndTurnedOnTheGround) {
  const Motion walk = strut::test::short_walk(0.3, 2.0);
  const Eigen::Quaterniond upright = motion::upright_reference(walk);
  const FrameMatrix here = joint_features(walk, upright);
  for (const double angle : {0.4, -2.0, 3.1}) {
    const FrameMatrix there = joint_features(motion::moved(walk, {3.0, 0.0, -2.0}, angle), upright);
    EXPECT_LT((here - there).cwiseAbs().maxCoeff(), kRounding);
  }
}

TEST(JointFeatures, ChangeWhenTheClipIsRaised) {
  const Motion walk = strut::test::short_walk(0.0, 1.0);
  const Eigen::Quaterniond upright = motion::upright_reference(walk);
  const FrameMatrix raised = joint_features(motion::moved(walk, {0.0, 0.5, 0.0}, 0.0), upright);
  const FrameMatrix change = raised - joint_features(walk, upright);
  for (Eigen::Index d = 0; d < change.cols(); ++d) {
    EXPECT_NEAR(change.col(d).mean(), d % 3 == 1 ? 0.5 : 0.0, kRounding);
  }
}

TEST(JointFeatures, AreDistancesOfTheBodyFromThePelvis) {
  const Motion walk = strut::test::short_walk(0.0, 1.0);
  const std::vector<int> joints = feature_joints(walk.skeleton());
  const FrameMatrix features = joint_features(walk, motion::upright_reference(walk));
  ASSERT_EQ(features.cols(), 3 * static_cast<Eigen::Index>(joints.size()));
  const motion::WorldPose world = motion::forward_kinematics(walk.skeleton(), walk.frame(7));
  const auto at = [&](std::size_t k) { return world.positions[static_cast<std::size_t>(joints[k])]; };
  EXPECT_NEAR(features(7, 1), at(0).y(), kRounding);
  for (std::size_t k = 1; k < joints.size(); ++k) {
    const Eigen::RowVector3d from_pelvis =
        features.block<1, 3>(7, 3 * static_cast<Eigen::Index>(k)) - features.block<1, 3>(7, 0);
    EXPECT_NEAR(from_pelvis.norm(), (at(k) - at(0)).norm(), kRounding);
  }
}

TEST(JointFeatures, OfAnEmptyClipAreNone) {
  const Motion walk = strut::test::short_walk(0.0, 1.0);
  EXPECT_EQ(joint_features(walk.slice(0, 0), motion::upright_reference(walk)).rows(), 0);
}

TEST(JointFeatures, RefuseAQuaternionThatIsNoRotation) {
  EXPECT_THROW(joint_features(strut::test::short_walk(0.0, 1.0), Eigen::Quaterniond(2.0, 0.0, 0.0, 0.0)),
               InvalidArgument);
}

TEST(FeatureSpace, HasOrthonormalComponentsByFallingVariance) {
  FrameMatrix clip = noise(300, 12, 1);
  clip.col(4) *= 5.0;
  const FeatureSpace space = fit_feature_space({clip, noise(50, 12, 2)}, 7);
  const Eigen::MatrixXd square = space.components.transpose() * space.components;
  EXPECT_LT((square - Eigen::MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), kRounding);
  const FrameMatrix rows = project(space, clip);
  EXPECT_GT(space.components(4, 0), 0.9) << "and its largest entry is positive";
  EXPECT_GT(rows.col(0).squaredNorm(), rows.col(1).squaredNorm());
  EXPECT_GT(space.kept, 0.5);
  EXPECT_LT(space.kept, 1.0);
}

TEST(FeatureSpace, KeepsDistancesThatLieInItAndNeverAddsToOthers) {
  const FrameMatrix flat = noise(100, 3, 1) * noise(3, 20, 2), full = noise(100, 20, 3);
  const FeatureSpace exact = fit_feature_space({flat});
  EXPECT_EQ(exact.components.cols(), 3) << "as many as the data has";
  EXPECT_NEAR(exact.kept, 1.0, kRounding);
  const FrameMatrix rows = project(exact, flat), few = project(fit_feature_space({full}, 6), full);
  for (Eigen::Index t = 1; t < 100; ++t) {
    EXPECT_NEAR((rows.row(t) - rows.row(0)).norm(), (flat.row(t) - flat.row(0)).norm(), 100.0 * kRounding);
    EXPECT_LE((few.row(t) - few.row(0)).norm(), (full.row(t) - full.row(0)).norm() + kRounding);
  }
}

TEST(FeatureSpace, OfABodyThatStandsStillHasOneDirection) {
  const FeatureSpace space = fit_feature_space({FrameMatrix::Constant(5, 6, 2.0)});
  EXPECT_EQ(space.components.cols(), 1);
  EXPECT_EQ(space.kept, 1.0);
  EXPECT_LT(project(space, FrameMatrix::Constant(2, 6, 2.0)).cwiseAbs().maxCoeff(), kRounding);
}

TEST(FeatureSpace, Keeps24DimensionsOfRealClipsToAFewMillimetres) {
  STRUT_REQUIRE_REAL_DATA();
  constexpr double kLeast = 0.995;  // of the variance
  std::vector<FrameMatrix> clips;
  for (const char* name : {"wave-both-hands_active_001", "walk_elderly_002", "raise-up-right-hand_normal_003"}) {
    const Motion clip = test::real_clip(name);
    clips.push_back(joint_features(clip, motion::upright_reference(clip)));
  }
  EXPECT_GT(fit_feature_space(clips).kept, kLeast);
}

TEST(FeatureSpace, RefusesWhatIsNoData) {
  FrameMatrix broken = noise(5, 4, 1);
  broken(2, 2) = std::nan("");
  EXPECT_THROW(fit_feature_space({}), InvalidArgument);
  EXPECT_THROW(fit_feature_space({FrameMatrix(0, 4)}), InvalidArgument);
  EXPECT_THROW(fit_feature_space({noise(5, 4, 1), noise(5, 3, 1)}), InvalidArgument);
  EXPECT_THROW(fit_feature_space({noise(5, 4, 1)}, 0), InvalidArgument);
  EXPECT_THROW(fit_feature_space({broken}), InvalidArgument);
  EXPECT_THROW(project(fit_feature_space({noise(5, 4, 1)}), noise(5, 3, 1)), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
