// SPDX-License-Identifier: MIT
// The whole upper row of the paper's Figure 3 on generated walks, whose true answers are known.
#include "learn/example_walks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/learn/learn_style.h>
#include <strut/metrics/clip_distance.h>
#include <strut/model/model_step.h>
#include <strut/model/style_model_io.h>
#include <strut/representation/representation.h>
#include <strut/translate/translate_motion.h>

namespace strut {
namespace {

using generate::generate_walk;
using generate::WalkContent;
using test::Clips;
using test::content;
using test::learn_from;
using test::limping;
using test::make_clips;
using test::varied_clips;

constexpr double kRate = test::kExampleRate;

std::string warnings(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& entry : diagnostics.entries()) {
    if (entry.severity == Severity::kWarning) text += entry.message + "\n";
  }
  return text;
}

TEST(LearnStyle, BringsANewWalkNearItsTrueStyle) {
  const LearntStyle learnt = learn_from(varied_clips());
  const WalkContent new_content = content(1.25, 0.15, 8.0);
  const Motion input = generate_walk(new_content, {.seed = 101}, kRate).motion;
  const Motion truth = generate_walk(new_content, limping(102), kRate).motion;
  const Motion translated = translate_motion(learnt.model, input);
  const double before = metrics::clip_distance(input, truth).distance;
  const double after = metrics::clip_distance(translated, truth).distance;
  // Measured 0.2; a wrong sign, swapped feet or a lost joint leaves more than half.
  EXPECT_LT(after, 0.4 * before);
  // Measured within 1 %; without the time warp the clip would be 15 % too short.
  EXPECT_NEAR(translated.duration() / truth.duration(), 1.0, 0.05);
}

TEST(LearnStyle, OfAStyleOntoItselfChangesLittle) {
  Clips clips = varied_clips();
  clips.outputs = clips.inputs;
  clips.pairs = learn::find_pairs(clips.inputs, clips.outputs).pairs;
  const LearntStyle learnt = learn_from(clips);
  const Motion input = generate_walk(content(1.25, 0.1), {.seed = 77}, kRate).motion;
  const double other_take =
      metrics::clip_distance(input, generate_walk(content(1.25, 0.1), {.seed = 78}, kRate).motion).distance;
  EXPECT_LT(metrics::clip_distance(translate_motion(learnt.model, input), input).distance, other_take + 0.01);
  EXPECT_NEAR(learnt.report.duration_ratio, 1.0, 0.02);
}

TEST(LearnStyle, DoesNotDependOnTheNumberOfThreads) {
  const auto bytes = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return format_style_model(*learn_from(varied_clips()).model);
  };
  EXPECT_EQ(bytes(1), bytes(2));
}

TEST(LearnStyle, WorksAcrossFrameRates) {
  Clips clips = make_clips({content(1.1, 0.0), content(1.4, 0.2), content(1.3, -0.2)}, 120.0);
  const LearntStyle learnt = learn_from(clips, {.frame_rate = kRate});
  EXPECT_EQ(learnt.model->frame_rate(), kRate);
  const Motion input = generate_walk(content(1.2, 0.0), {.seed = 5}, 120.0).motion;
  const Motion truth = generate_walk(content(1.2, 0.0), limping(6), 120.0).motion;
  const Motion translated = translate_motion(learnt.model, input);
  EXPECT_EQ(translated.frame_rate(), 120.0);
  EXPECT_LT(metrics::clip_distance(translated, truth).distance, 0.6 * metrics::clip_distance(input, truth).distance);
}

TEST(LearnStyle, ReportsWhatItLearnt) {
  const LearntStyle learnt = learn_from(varied_clips());
  EXPECT_EQ(learnt.report.num_pairs, static_cast<int>(varied_clips().pairs.size()));
  std::vector<std::string> parts;
  for (const BlockReport& block : learnt.report.blocks) {
    parts.push_back(block.name);
    EXPECT_EQ(block.states, 0) << block.name;
    EXPECT_LE(block.left_out_fit, 100.0) << block.name;
    EXPECT_GT(block.fit, 0.0) << block.name;
  }
  EXPECT_EQ(parts.front(), "root");
  EXPECT_THAT(parts, testing::Contains("LeftLeg"));
  EXPECT_EQ(parts.back(), "timing");
  EXPECT_LT(learnt.report.speed.least, 1.1);
  EXPECT_GT(learnt.report.speed.greatest, 1.4);
  EXPECT_GT(learnt.report.turning_rate.greatest, 0.3);
  EXPECT_LT(learnt.report.turning_rate.least, -0.3);
  double input_duration = 0.0, output_duration = 0.0;
  for (const Motion& clip : varied_clips().inputs) input_duration += clip.duration();
  for (const Motion& clip : varied_clips().outputs) output_duration += clip.duration();
  // Pairs are single cycles, not the same mix of them as the clips.
  EXPECT_NEAR(learnt.report.duration_ratio, output_duration / input_duration, 0.05);
}

// Of a cycle of 33 frames, a frame at each of two boundaries is 6 %.
constexpr double kFootplantAgreement = 0.94;

TEST(LearnStyle, TellsFootplantsOfNewWalksInTheNewStyle) {
  for (const LearnMethod method : {LearnMethod::kRadial, LearnMethod::kLinear}) {
    const LearntStyle learnt = learn_from(varied_clips(), {.method = method});
    ASSERT_TRUE(learnt.report.footplants);
    EXPECT_GT(learnt.report.footplants->agreement, kFootplantAgreement);
    EXPECT_GT(learnt.report.footplants->left_out_agreement, kFootplantAgreement);
    ASSERT_TRUE(learnt.model->footplants());
    const WalkContent new_content = content(1.25, 0.15, 8.0);
    const generate::Walk input = generate_walk(new_content, {.seed = 101}, kRate);
    const generate::Walk truth = generate_walk(new_content, limping(102), kRate);
    const auto output_frames = generate::true_correspondence(input, truth);
    const FrameMatrix rows = representation::encode(learnt.model->input(), input.motion);
    ModelStep<double> step(learnt.model);
    Eigen::RowVectorXd output(learnt.model->num_dofs() + 1);
    Eigen::VectorXd state(learnt.model->state_size());
    double right = 0.0, all = 0.0;
    for (Eigen::Index t = 0; t < rows.rows(); ++t) {
      step.step(rows.row(t), output);
      step.state(state);
      if (static_cast<double>(t) < kRate) continue;  // the states settle
      for (int foot = 0; foot < 2; ++foot) {
        const auto frame = static_cast<int>(std::lround(output_frames[static_cast<std::size_t>(t)]));
        const bool is_planted =
            std::any_of(truth.footplants.begin(), truth.footplants.end(), [&](const motion::Footplant& plant) {
              return plant.foot == foot && plant.begin <= frame && frame < plant.end;
            });
        right += learnt.model->footplants()->is_planted(foot, state) == is_planted ? 1.0 : 0.0;
        all += 1.0;
      }
    }
    EXPECT_GT(right / all, kFootplantAgreement);
  }
}

TEST(LearnStyle, TakesTheFootplantsItIsGiven) {
  const Clips clips = varied_clips();
  LearnOptions options;
  for (const Motion& clip : clips.outputs) options.footplants.push_back({{0, 0, clip.num_frames()}});
  const LearntStyle learnt = learn_from(clips, options);
  const Eigen::VectorXd state = Eigen::VectorXd::Ones(learnt.model->state_size());
  EXPECT_TRUE(learnt.model->footplants()->is_planted(0, state));
  EXPECT_FALSE(learnt.model->footplants()->is_planted(1, state));
  options.footplants.back().push_back({2, 0, 1});
  EXPECT_THROW(learn_from(clips, options), InvalidArgument);
  options.footplants.pop_back();
  EXPECT_THROW(learn_from(clips, options), InvalidArgument);
}

TEST(LearnStyle, WarnsOfWhatTheExamplesDoNotCover) {
  Diagnostics diagnostics;
  learn_from(make_clips({content(1.3, 0.0), content(1.3, 0.0)}), {}, &diagnostics);
  EXPECT_THAT(warnings(diagnostics), testing::HasSubstr("one speed only"));
  EXPECT_THAT(warnings(diagnostics), testing::HasSubstr("hardly turn"));
  Diagnostics one_side;
  learn_from(make_clips({content(1.0, 0.4), content(1.5, 0.4)}), {}, &one_side);
  EXPECT_THAT(warnings(one_side), testing::HasSubstr("turn to the left only"));
  Diagnostics none;
  learn_from(varied_clips(), {}, &none);
  EXPECT_THAT(warnings(none), testing::Not(testing::HasSubstr("turn")));
}

TEST(LearnStyle, KeepsItsProvenance) {
  const Clips& clips = varied_clips();
  const auto learnt = learn_style(clips.inputs, clips.outputs, clips.pairs, {},
                                  [](const LearnReport& report) { return std::to_string(report.num_pairs); });
  EXPECT_EQ(learnt.model->provenance(), std::to_string(clips.pairs.size()));
}

TEST(LearnStyle, RefusesPairsThatDoNotExist) {
  const Clips& clips = varied_clips();
  EXPECT_THROW(learn_style(clips.inputs, clips.outputs, {}), InvalidArgument);
  auto pairs = clips.pairs;
  pairs[0].input_clip = 99;
  EXPECT_THROW(learn_style(clips.inputs, clips.outputs, pairs), InvalidArgument);
  pairs = clips.pairs;
  pairs[0].output_frames.end = 100000;
  EXPECT_THROW(learn_style(clips.inputs, clips.outputs, pairs), InvalidArgument);
  pairs = clips.pairs;
  pairs[0].input_frames.end = pairs[0].input_frames.begin;
  EXPECT_THROW(learn_style(clips.inputs, clips.outputs, pairs), InvalidArgument);
  EXPECT_THROW(learn_style(clips.inputs, clips.outputs, clips.pairs, {.longest_memory = 0.0}), InvalidArgument);
}

TEST(LearnStyle, LeavesOutPairsThatCannotBeAlignedAndSaysWhy) {
  const Clips& clips = varied_clips();
  std::vector<learn::ClipPair> pairs = clips.pairs;
  pairs[0].output_frames.end = pairs[0].output_frames.begin + 3;  // a tenth of a second against a cycle
  Diagnostics diagnostics;
  const auto learnt = learn_style(clips.inputs, clips.outputs, pairs, {}, {}, &diagnostics);
  EXPECT_EQ(learnt.report.num_refused, 1);
  EXPECT_THAT(warnings(diagnostics), testing::HasSubstr("left out"));
  EXPECT_THROW(learn_style(clips.inputs, clips.outputs, {pairs[0]}), InvalidArgument);
}

TEST(LearnStyle, RefusesDifferentSkeletons) {
  const Clips& clips = varied_clips();
  const auto other = std::make_shared<const Skeleton>(std::vector<Joint>{{"hips", -1}, {"a", 0}, {"b", 0}});
  const std::vector<Motion> outputs(clips.outputs.size(),
                                    Motion(other, kRate, std::vector<Pose>(400, rest_pose(*other))));
  EXPECT_THROW(learn_style(clips.inputs, outputs, clips.pairs), SkeletonMismatch);
}

}  // namespace
}  // namespace strut
