// SPDX-License-Identifier: MIT
// What each way of learning promises, on generated walks. Tests run one by one, so each learns little and asks much.
#include "learn/example_walks.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <strut/core/error.h>
#include <strut/metrics/clip_distance.h>
#include <strut/metrics/smoothness.h>
#include <strut/model/model_step.h>
#include <strut/model/radial_map.h>
#include <strut/model/style_model_io.h>
#include <strut/translate/translate_motion.h>

namespace strut {
namespace {

using generate::generate_walk;
using test::Clips;
using test::content;
using test::kExampleRate;
using test::learn_from;
using test::limping;
using test::make_clips;

Clips three_clips() {
  return make_clips({content(1.0, 0.0), content(1.4, 0.3), content(1.3, -0.3)});
}

/// A clip of two and a half seconds in each style, paired whole.
Clips short_clips() {
  Clips clips = make_clips({content(1.2, 0.0, 2.5)});
  clips.pairs = learn::find_pairs(clips.inputs, clips.outputs, {.whole = true}).pairs;
  return clips;
}

/// How far from its true style a walk that was not learnt from lies when it is translated, in untranslated distances.
double distance_left(const StyleModel& model, double speed) {
  const auto walk = content(speed, 0.1);
  const Motion input = generate_walk(walk, {.seed = 101}, kExampleRate).motion;
  const Motion truth = generate_walk(walk, limping(102), kExampleRate).motion;
  const Motion translated = translate_motion(std::make_shared<const StyleModel>(model), input);
  return metrics::clip_distance(translated, truth).distance / metrics::clip_distance(input, truth).distance;
}

FrameMatrix run(const LearntStyle& learnt, const FrameMatrix& rows) {
  ModelStep<double> translator(learnt.model);
  FrameMatrix outputs(rows.rows(), rows.cols() + 1);
  for (Eigen::Index t = 0; t < rows.rows(); ++t) translator.step(rows.row(t), outputs.row(t));
  return outputs;
}

double mean_jerk(const std::vector<Motion>& clips) {
  double sum = 0.0, frames = 0.0;
  for (const Motion& clip : clips) {
    sum += metrics::smoothness(clip).jerk * clip.num_frames();
    frames += clip.num_frames();
  }
  return sum / frames;
}

TEST(RadialMethod, ComesNearTheTrueStyleAsSmoothAsItIs) {
  const Clips clips = three_clips();
  const LearntStyle learnt = learn_from(clips);
  EXPECT_TRUE(learnt.model->radial_map());
  EXPECT_TRUE(learnt.model->blocks().empty());
  EXPECT_LT(distance_left(*learnt.model, 1.25), 0.2);  // measured 0.1
  std::vector<Motion> translated;
  for (const Motion& clip : clips.inputs) translated.push_back(translate_motion(learnt.model, clip));
  const double roughness = mean_jerk(translated) / mean_jerk(clips.outputs);
  EXPECT_GT(roughness, 0.8);  // below, the eye finds it sluggish
  EXPECT_LT(roughness, 1.25);
}

TEST(RadialMethod, GivesTheExamplesTheirDurations) {
  const Clips clips = three_clips();
  const LearntStyle learnt = learn_from(clips);
  std::vector<FrameMatrix> outputs;
  for (const Motion& clip : clips.inputs)
    outputs.push_back(run(learnt, representation::encode(learnt.model->input(), clip)));
  double real = 0.0, given = 0.0;
  for (const learn::ClipPair& pair : clips.pairs) {
    const auto log_warp = outputs[static_cast<std::size_t>(pair.input_clip)].col(learnt.model->time_warp_dof());
    real += pair.output_frames.num_frames();
    given += log_warp.segment(pair.input_frames.begin, pair.input_frames.num_frames()).array().exp().sum();
  }
  EXPECT_NEAR(given / real, 1.0, 0.02);
}

TEST(RadialMethod, KeepsAPerformersOwnPostureInOneJointAndNowhereElse) {
  const LearntStyle learnt = learn_from(test::varied_clips());
  const representation::Representation& body = learnt.model->input();
  const FrameMatrix rows =
      representation::encode(body, generate_walk(content(1.25, 0.1), {.seed = 101}, kExampleRate).motion);
  const auto part = std::find_if(body.joints().begin(), body.joints().end(),
                                 [&](int joint) { return body.skeleton().joint(joint).name == "RightArm"; });
  ASSERT_NE(part, body.joints().end());
  const Eigen::Index dof = representation::kNumRootDofs + 3 * (part - body.joints().begin());
  const Eigen::Vector3d detail(0.3, -0.2, 1.0);  // an arm held aside: far from what any example does
  FrameMatrix with = rows;
  constexpr Eigen::Index kBegin = 60, kSecond = 30;
  with.block(kBegin, dof, with.rows() - kBegin, 3).rowwise() += detail.transpose();
  FrameMatrix change = (run(learnt, with) - run(learnt, rows)).middleRows(kBegin + kSecond, 2 * kSecond);
  const Eigen::Vector3d kept = change.middleCols(dof, 3).colwise().mean().transpose();
  EXPECT_NEAR(kept.norm() / detail.norm(), 1.0, 0.15);
  change.middleCols(dof, 3).setZero();
  change.leftCols(representation::kHeight).setZero();  // velocities, whose units are others
  EXPECT_LT(change.cwiseAbs().maxCoeff(), 0.1);
}

TEST(RadialMethod, SeesTheBodysPrincipalComponents) {
  const Clips clips = three_clips();
  const LearntStyle learnt = learn_from(clips, {.context = 5});
  const Eigen::MatrixXd& context = learnt.model->context();
  ASSERT_EQ(context.rows(), 5);
  Eigen::MatrixXd products = context * context.transpose();
  const double square = products(0, 0);
  products.diagonal().array() -= square;
  EXPECT_LT(products.norm(), 1e-9 * square);  // orthogonal, all of one length
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(5);
  for (const Motion& clip : clips.inputs) {
    const FrameMatrix rows =
        learnt.model->input_scaling().normalize(representation::encode(learnt.model->input(), clip));
    squares += (rows * context.transpose()).colwise().squaredNorm().transpose() / (3.0 * double(rows.rows()));
  }
  EXPECT_NEAR(squares[0], 1.0, 0.2);  // of the paired cycles exactly 1; clips have ends
  for (int k = 1; k < 5; ++k) EXPECT_LT(squares[k], squares[k - 1]) << k;
}

TEST(RadialMethod, IsJudgedByAMapThatNeverSawWhatIsLeftOut) {
  const LearntStyle learnt = learn_from(three_clips());
  double left_out = 0.0;
  for (const BlockReport& block : learnt.report.blocks) left_out += block.left_out_fit;
  // Measured 66; a basis that stands on the left-out clips too has centres there without weights, and predicts nothing.
  EXPECT_GT(left_out / static_cast<double>(learnt.report.blocks.size()), 40.0);
  // Nor would it leave details smaller than the movement itself.
  const representation::Normalization& scaling = learnt.model->input_scaling();
  const Eigen::ArrayXd spread = learnt.model->radial_map()->spread.array();
  const Eigen::ArrayXd kept = (scaling.scale().array() > 0.0).cast<double>();
  EXPECT_LT((kept * spread).tail(learnt.model->num_dofs() - representation::kNumRootDofs).sum(),
            0.6 * scaling.scale().tail(learnt.model->num_dofs() - representation::kNumRootDofs).sum());
}

TEST(RadialMethod, LearnsFromASingleShortPair) {
  const Clips clips = short_clips();
  ASSERT_EQ(clips.pairs.size(), 1U);
  const LearntStyle learnt = learn_from(clips);
  EXPECT_LT(distance_left(*learnt.model, 1.2), 0.4);  // measured 0.1
  // Nothing can be left out: what was learnt from is judged.
  for (const BlockReport& block : learnt.report.blocks) {
    EXPECT_NEAR(block.left_out_fit, block.fit, 1e-9) << block.name;
    EXPECT_GT(block.fit, 50.0) << block.name;
  }
}

TEST(LinearMethod, SeesTheContextAndComesNearTheTrueStyle) {
  const LearntStyle learnt =
      learn_from(three_clips(),
                 {.method = LearnMethod::kLinear, .context = 4, .lead_in = 0.3, .identification = {.max_order = 2}});
  EXPECT_FALSE(learnt.model->radial_map());
  const int dofs = learnt.model->num_dofs();
  EXPECT_TRUE(std::any_of(learnt.model->blocks().begin(), learnt.model->blocks().end(),
                          [&](const StyleBlock& block) { return block.input_dofs.back() >= dofs; }));
  ASSERT_EQ(learnt.report.blocks.size(), learnt.model->blocks().size());
  for (std::size_t b = 0; b < learnt.report.blocks.size(); ++b) {
    EXPECT_EQ(learnt.report.blocks[b].name, learnt.model->blocks()[b].name);
    EXPECT_EQ(learnt.report.blocks[b].states, learnt.model->blocks()[b].system.num_states());
  }
  EXPECT_LT(distance_left(*learnt.model, 1.25), 0.35);  // measured 0.15
}

TEST(LinearMethod, TellsAJointThatOnlyTheOutputMovesFromTheContext) {
  Clips clips = three_clips();
  constexpr std::size_t kArm = 6;  // any joint that the walk moves
  for (Motion& clip : clips.inputs) {
    std::vector<Pose> frames = clip.frames();
    for (Pose& pose : frames) pose.rotations[kArm] = Eigen::Quaterniond::Identity();
    clip = Motion(clip.shared_skeleton(), clip.frame_rate(), std::move(frames));
  }
  const LearntStyle learnt = learn_from(clips, {.method = LearnMethod::kLinear, .identification = {.max_order = 2}});
  const std::string& name = clips.inputs.front().skeleton().joint(kArm).name;
  const auto& blocks = learnt.model->blocks();
  const auto block = std::find_if(blocks.begin(), blocks.end(), [&](const StyleBlock& b) { return b.name == name; });
  ASSERT_NE(block, blocks.end()) << name;
  EXPECT_GE(*std::min_element(block->input_dofs.begin(), block->input_dofs.end()),
            learnt.model->input_scaling().num_dofs());
}

TEST(LinearMethod, IsWhatIsLeftWithoutAContext) {
  const LearntStyle learnt = learn_from(short_clips(), {.context = 0, .identification = {.max_order = 2}});
  EXPECT_FALSE(learnt.model->radial_map());
  EXPECT_EQ(learnt.model->context().rows(), 0);
  EXPECT_GT(learnt.model->num_states(), 0);
  for (const BlockReport& block : learnt.report.blocks) EXPECT_TRUE(std::isfinite(block.left_out_fit)) << block.name;
}

TEST(PaperMethod, LearnsEachJointFromItsOwnInputs) {
  const LearntStyle learnt = learn_from(short_clips(), {.method = LearnMethod::kPaper});
  EXPECT_FALSE(learnt.model->radial_map());
  EXPECT_EQ(learnt.model->context().rows(), 0);
  EXPECT_GT(learnt.model->num_states(), 0);
}

TEST(LearnMethods, DoNotDependOnTheNumberOfThreads) {
  const Clips clips = short_clips();
  for (const LearnMethod method : {LearnMethod::kLinear, LearnMethod::kPaper}) {  // the radial one: learn_style_test
    const auto bytes = [&](std::size_t threads) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      return format_style_model(
          *learn_from(clips, {.method = method, .lead_in = 0.2, .identification = {.max_order = 2}}).model);
    };
    EXPECT_EQ(bytes(1), bytes(2)) << static_cast<int>(method);
  }
}

TEST(LearnMethods, SmoothTheTimeWarpAsToldOrATenthOfASecondWhereNothingShowsHow) {
  const Clips clips = short_clips();  // one pair: no other warp of its stretch to predict
  const auto model_with = [&](std::optional<double> smoothing) {
    return format_style_model(*learn_from(clips, {.time_warp_smoothing = smoothing}).model);
  };
  EXPECT_EQ(model_with(std::nullopt), model_with(0.1));
  EXPECT_NE(model_with(std::nullopt), model_with(0.3));
}

TEST(LearnMethods, RefuseOptionsOutOfRange) {
  const Clips clips = short_clips();
  const auto refusal = [&](const LearnOptions& options) -> std::string {
    try {
      learn_from(clips, options);
    } catch (const InvalidArgument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal({.time_warp_smoothing = -1.0}),
            "time_warp_smoothing: expected a number of at least 0.000000, got -1.000000");
  EXPECT_EQ(refusal({.context = -1}), "context: expected a number of at least 0.000000, got -1.000000");
  EXPECT_EQ(refusal({.radial = {.centres = 0}}),
            "radial.centres: expected a number of at least 1.000000, got 0.000000");
  EXPECT_EQ(refusal({.radial = {.width = 0.0}}), "radial.width: expected a number of at least 0.010000, got 0.000000");
  EXPECT_THAT(refusal({.radial = {.ridge = 0.0}}), testing::StartsWith("radial.ridge: expected a number of at least "));
  EXPECT_EQ(refusal({.radial = {.lags = 0}}), "radial.lags: expected a number of at least 1.000000, got 0.000000");
  EXPECT_EQ(refusal({.radial = {.lag = NAN}}), "radial.lag: expected a number of at least 0.000000, got nan");
}

/// What a model makes of its own examples, one after the other.
FrameMatrix outputs_of(const LearnMethod method, AlignmentMethod alignment) {
  const Clips clips = short_clips();
  LearnOptions options;
  options.method = method;
  options.alignment_method = alignment;
  const LearntStyle learnt = learn_from(clips, options);
  const auto& model = *learnt.model;
  const FrameMatrix rows = model.input_scaling().normalize(representation::encode(model.input(), clips.inputs.front()));
  return run(learnt, rows);
}

TEST(AlignmentMethod, OfThePaperIsThePapersWhateverIsAskedFor) {
  EXPECT_EQ(outputs_of(LearnMethod::kPaper, AlignmentMethod::kContinuous),
            outputs_of(LearnMethod::kPaper, AlignmentMethod::kIterative));
}

TEST(AlignmentMethod, IsContinuousUnlessIterativeIsAskedFor) {
  const FrameMatrix continuous = outputs_of(LearnMethod::kRadial, AlignmentMethod::kContinuous);
  EXPECT_EQ(continuous, outputs_of(LearnMethod::kRadial, LearnOptions{}.alignment_method));
  EXPECT_NE(continuous, outputs_of(LearnMethod::kRadial, AlignmentMethod::kIterative));
}

}  // namespace
}  // namespace strut
