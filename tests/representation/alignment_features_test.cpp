// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <strut/align/iterative_motion_warping.h>
#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/motion/kinematics.h>
#include <strut/representation/alignment_features.h>
#include <strut/representation/representation.h>

namespace strut::representation {
namespace {

constexpr double kRounding = 1e-9;  // encoding turns poses by a few rotations

generate::Walk walk(const generate::WalkStyle& style) {
  generate::WalkContent content;
  content.duration = 3.0;
  content.turn_rate = 0.4;
  return generate::generate_walk(content, style, 30.0);
}

generate::WalkStyle crouch() {
  generate::WalkStyle style;
  style.crouch = 0.2;
  style.cadence_scale = 0.8;
  style.seed = 2;
  return style;
}

TEST(AlignmentFeatures, HaveUnitVarianceOrAreZero) {
  const AlignmentPair pair = alignment_features(walk({}).motion, walk(crouch()).motion);
  ASSERT_EQ(pair.input.cols(), pair.output.cols());
  int moving = 0;
  for (Eigen::Index d = 0; d < pair.input.cols(); ++d) {
    const bool zero = pair.input.col(d).isZero(0.0);
    EXPECT_EQ(zero, pair.output.col(d).isZero(0.0)) << d;
    if (zero) continue;
    ++moving;
    EXPECT_NEAR(pair.input.col(d).mean(), 0.0, kRounding);
    EXPECT_NEAR(pair.input.col(d).squaredNorm() / static_cast<double>(pair.input.rows()), 1.0, 0.05);
  }
  EXPECT_GT(moving, 10);
}

TEST(AlignmentFeatures, DoNotSeeWhereTheBodyIs) {
  const Motion still = walk({}).motion;
  const Motion elsewhere = motion::moved(still, Eigen::Vector3d(3.0, 0.0, -2.0), 1.3);
  const AlignmentPair pair = alignment_features(still, elsewhere);
  EXPECT_LT((pair.input - pair.output).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(AlignmentFeatures, InSharedUnitsKeepADifferenceOfPosture) {
  const Motion upright = walk({}).motion, crouched = walk(crouch()).motion;
  const auto offset = [](const AlignmentPair& pair) {
    return (pair.input.colwise().mean() - pair.output.colwise().mean()).norm();
  };
  EXPECT_LT(offset(alignment_features(upright, crouched)), kRounding);
  EXPECT_GT(offset(alignment_features(upright, crouched, StyleUnits::kShared)), 1.0);
}

/// What the whole folder is for: the known correspondence of a walk and a crouch.
TEST(AlignmentFeatures, LeadIterativeMotionWarpingToTheTrueCorrespondence) {
  const generate::Walk input = walk({}), output = walk(crouch());
  const AlignmentPair pair = alignment_features(input.motion, output.motion);
  const Eigen::VectorXd found = align::iterative_motion_warping(pair.input, pair.output).correspondence.output_time();
  const std::vector<double> truth = generate::true_correspondence(input, output);
  double error = 0.0;
  for (Eigen::Index t = 0; t < found.size(); ++t) error += std::abs(found[t] - truth[static_cast<std::size_t>(t)]);
  EXPECT_LT(error / static_cast<double>(found.size()), 0.6);  // frames; the study measures 0.4 over many crouches
}

TEST(AlignmentFeatures, RefuseAnotherHierarchy) {
  const Motion walker = walk({}).motion;
  const auto bone = std::make_shared<const Skeleton>(std::vector<Joint>{Joint{}});
  EXPECT_THROW(alignment_features(walker, Motion(bone, 30.0, {rest_pose(*bone), rest_pose(*bone)})), SkeletonMismatch);
}

}  // namespace
}  // namespace strut::representation
