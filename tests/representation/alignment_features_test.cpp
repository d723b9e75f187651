// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <strut/align/continuous_warp.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
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

TEST(TimingFeatures, LeadTheContinuousWarpNearerToTheTruthThanPostureLeadsIterativeMotionWarping) {
  const generate::Walk input = walk({}), output = walk(crouch());
  const std::vector<double> truth = generate::true_correspondence(input, output);
  const auto error = [&](const align::Correspondence& found) {
    const Eigen::VectorXd time = found.output_time();
    double sum = 0.0;
    for (Eigen::Index t = 0; t < time.size(); ++t) sum += std::abs(time[t] - truth[static_cast<std::size_t>(t)]);
    return sum / static_cast<double>(time.size());
  };
  const TimingPair timing = timing_features(input.motion, output.motion);
  align::ContinuousWarpOptions options;
  options.weights = timing.weights;
  const AlignmentPair posture = alignment_features(input.motion, output.motion);
  EXPECT_LT(error(align::continuous_warp(timing.input, timing.output, 30.0, options).correspondence),
            0.7 * error(align::iterative_motion_warping(posture.input, posture.output).correspondence));
}

TEST(TimingFeatures, ShareTheWeightOfEachGroup) {
  const TimingPair pair = timing_features(walk({}).motion, walk(crouch()).motion, {1.0, 0.5, 4.0});
  const Eigen::Index dofs = (pair.input.cols() - 2) / 2;
  EXPECT_NEAR(pair.weights.head(dofs).sum(), 1.0, kRounding);
  EXPECT_NEAR(pair.weights.segment(dofs, dofs).sum(), 0.5, kRounding);
  EXPECT_NEAR(pair.weights.tail(2).sum(), 4.0, kRounding);
  for (Eigen::Index d = 0; d < pair.input.cols(); ++d) {
    EXPECT_EQ(pair.weights[d] == 0.0, pair.input.col(d).isZero(0.0) && pair.output.col(d).isZero(0.0)) << d;
  }
}

TEST(TimingFeatures, OfAGroupAreInTheUnitsOfEachMotion) {
  generate::WalkStyle brisk;
  brisk.cadence_scale = 1.2;
  const std::vector<Motion> motions{walk({}).motion, walk(crouch()).motion, walk(brisk).motion};
  const auto legs = motion::find_legs(motions.front());
  const TimingGroup group = timing_features(motions, legs);
  ASSERT_EQ(group.clips.size(), 3U);
  const TimingPair pair = timing_features(motions[0], motions[1]);
  ASSERT_EQ(group.clips[0].cols(), pair.input.cols());
  const Eigen::Index dofs = (pair.input.cols() - 2) / 2;
  for (Eigen::Index d = 0; d < 2 * dofs; ++d) {  // all but the feet, which are in one unit for all
    if (group.weights[d] == 0.0) continue;
    EXPECT_EQ(group.clips[0].col(d), pair.input.col(d)) << d;
    EXPECT_EQ(group.clips[1].col(d), pair.output.col(d)) << d;
  }
  EXPECT_EQ(timing_features(motions, std::nullopt).weights.size(), 2 * dofs);
  EXPECT_THROW(timing_features(std::vector<Motion>{}, legs), InvalidArgument);
}

TEST(TimingFeatures, OfAGroupLeaveOutWhatIsStillInOneOfThem) {
  const Motion moving = walk({}).motion;
  const Motion still(moving.shared_skeleton(), 30.0, std::vector<Pose>(20, moving.frames().front()));
  const TimingGroup group = timing_features({moving, walk(crouch()).motion, still}, motion::find_legs(moving));
  EXPECT_TRUE(group.weights.isZero(0.0));
  for (const FrameMatrix& clip : group.clips) EXPECT_TRUE(clip.isZero(0.0));
}

TEST(TimingFeatures, OfPostureAloneAreTheAlignmentFeatures) {
  const Motion input = walk({}).motion, output = walk(crouch()).motion;
  const TimingPair timing = timing_features(input, output, {1.0, 0.0, 0.0});
  const AlignmentPair posture = alignment_features(input, output);
  EXPECT_EQ(timing.input, posture.input);
  EXPECT_EQ(timing.output, posture.output);
}

TEST(TimingFeatures, DoWithoutFeet) {
  const Motion motion = walk({}).motion;
  const auto representation = fit_representation({motion}, motion::upright_reference(motion));
  const StyleClips clips{{encode(representation, motion)}, {}};
  const TimingFeatures features = timing_features(clips, clips, 30.0, {1.0, 0.0, 4.0});
  EXPECT_EQ(features.input.front().cols(), representation.num_dofs() - kHeight);
}

TEST(TimingFeatures, RefuseBadSharesRatesAndSizes) {
  const Motion motion = walk({}).motion;
  const auto representation = fit_representation({motion}, motion::upright_reference(motion));
  const StyleClips clips{{encode(representation, motion)}, {}};
  EXPECT_THROW(timing_features(clips, clips, 0.0), InvalidArgument);
  EXPECT_THROW(timing_features(clips, clips, 30.0, {1.0, -0.5, 4.0}), InvalidArgument);
  EXPECT_THROW(timing_features(clips, {}, 30.0), InvalidArgument);
  const StyleClips short_of_frames{clips.rows, {FrameMatrix::Zero(3, 2)}};
  EXPECT_THROW(timing_features(short_of_frames, clips, 30.0), InvalidArgument);
}

/// A toe that does not move is still, one that swings is not; so at any frame rate.
TEST(FootStillness, IsOneWhereTheToeStandsAndNearZeroWhereItSwings) {
  for (const double rate : {30.0, 120.0}) {
    generate::WalkContent content;
    content.duration = 4.0;
    const generate::Walk walk = generate::generate_walk(content, {}, rate);
    const FrameMatrix stillness = foot_stillness(walk.motion, *motion::find_legs(walk.motion));
    const int margin = static_cast<int>(rate / 15.0);
    for (const motion::Footplant& plant : walk.footplants) {
      for (int t = plant.begin + margin; t < plant.end - margin; ++t) EXPECT_GT(stillness(t, plant.foot), 0.99) << t;
    }
    EXPECT_GE(stillness.minCoeff(), 0.0);
    EXPECT_LE(stillness.maxCoeff(), 1.0);
    EXPECT_LT(stillness.col(0).minCoeff(), 0.05);
    EXPECT_LT(stillness.col(1).minCoeff(), 0.05);
  }
}

TEST(FootStillness, RefusesAnEmptyMotion) {
  const Motion motion = walk({}).motion;
  const Motion empty(motion.shared_skeleton(), 30.0);
  EXPECT_THROW(foot_stillness(empty, *motion::find_legs(motion)), InvalidArgument);
}

TEST(AlignmentFeatures, RefuseAnotherHierarchy) {
  const Motion walker = walk({}).motion;
  const auto bone = std::make_shared<const Skeleton>(std::vector<Joint>{Joint{}});
  EXPECT_THROW(alignment_features(walker, Motion(bone, 30.0, {rest_pose(*bone), rest_pose(*bone)})), SkeletonMismatch);
}

}  // namespace
}  // namespace strut::representation
