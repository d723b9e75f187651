// SPDX-License-Identifier: MIT
// What is said of the examples: the rules on made-up figures, the counts on generated walks.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/generate/walker.h>
#include <strut/learn/learn_report.h>
#include <strut/learn/learn_style.h>

namespace strut {
namespace {

using learn::poorly_predicted;
using learn::short_of_takes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

LearnReport report_of(std::vector<BlockReport> blocks, int num_left_out = 10) {
  LearnReport report;
  report.num_left_out = num_left_out;
  report.blocks = std::move(blocks);
  return report;
}

std::vector<std::string> names(const std::vector<BlockReport>& blocks) {
  std::vector<std::string> result;
  for (const BlockReport& block : blocks) result.push_back(block.name);
  return result;
}

TEST(PoorlyPredicted, IsBelowTwentyPercentOnPairsLeftOutWorstFirst) {
  const LearnReport report = report_of({{"a", 0, 19.9, 25.0}, {"b", 0, 20.0, 25.0}, {"c", 0, -3.0, 2.0}});
  EXPECT_THAT(names(poorly_predicted(report)), ElementsAre("c", "a"));
}

TEST(ShortOfTakes, LosesMoreThanTenPointsOnPairsLeftOutMostFirst) {
  const LearnReport report =
      report_of({{"a", 0, 69.0, 80.0}, {"b", 0, 70.0, 80.0}, {"c", 0, 10.0, 60.0}, {"d", 0, 90.0, 80.0}});
  EXPECT_THAT(names(short_of_takes(report)), ElementsAre("c", "a"));
}

TEST(ShortOfTakes, AndPoorlyPredictedSayNothingWhereNothingWasLeftOut) {
  const LearnReport report = report_of({{"a", 0, 0.0, 80.0}}, 0);
  EXPECT_THAT(short_of_takes(report), IsEmpty());
  EXPECT_THAT(poorly_predicted(report), IsEmpty());
}

struct Clips {
  std::vector<Motion> inputs, outputs;
  std::vector<learn::ClipPair> pairs;
};

Clips walks(int inputs, int outputs) {
  const auto walk = [](int k, double limp, double duration) {
    const generate::WalkContent content{.duration = duration, .speed = 1.0 + 0.2 * k, .turn_rate = 0.2 * (k - 1)};
    return generate::generate_walk(content, {.limp = limp, .seed = static_cast<std::uint64_t>(k + 1)}, 30.0).motion;
  };
  Clips clips;
  for (int k = 0; k < inputs; ++k) clips.inputs.push_back(walk(k, 0.0, 4.0));
  for (int k = 0; k < outputs; ++k) clips.outputs.push_back(walk(k, 0.8, 4.0));
  clips.pairs = learn::find_pairs(clips.inputs, clips.outputs).pairs;
  return clips;
}

LearnReport learnt_from(const Clips& clips, const LearnOptions& options = {}, Diagnostics* diagnostics = nullptr) {
  return learn_style(clips.inputs, clips.outputs, clips.pairs, options, {}, diagnostics).report;
}

std::string said(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& entry : diagnostics.entries()) text += entry.message + "\n";
  return text;
}

TEST(LearnReport, CountsRecordingsCentresAndPairsLeftOut) {
  const Clips clips = walks(3, 3);
  Diagnostics diagnostics;
  const LearnReport report = learnt_from(clips, {}, &diagnostics);
  EXPECT_EQ(report.num_input_clips, 3);
  EXPECT_EQ(report.num_output_clips, 3);
  EXPECT_GT(report.num_left_out, 0);
  EXPECT_LE(report.num_left_out, report.num_pairs);
  EXPECT_GT(report.num_centres, 0);
  EXPECT_THAT(said(diagnostics), Not(HasSubstr("left out")));
}

TEST(LearnReport, CountsNoCentresOfLinearSystems) {
  EXPECT_EQ(learnt_from(walks(2, 2), {.method = LearnMethod::kPaper}).num_centres, 0);
}

TEST(LearnReport, TellsDurationsOfCyclesInBothStyles) {
  const LearnReport report = learnt_from(walks(3, 3));
  EXPECT_GT(report.input_duration.least, 0.7);
  EXPECT_LT(report.input_duration.greatest, 1.5);
  EXPECT_GT(report.output_duration.least, 0.7);
  EXPECT_LT(report.output_duration.greatest, 1.5);
}

TEST(LearnReport, CountsInputThatSeveralPairsShareOnce) {
  const Clips clips = walks(1, 1);
  const LearnReport report = learnt_from(clips);
  EXPECT_LE(report.seconds, clips.inputs.front().duration() + 1e-9);
  EXPECT_GT(report.seconds, 0.5 * clips.inputs.front().duration());
}

TEST(LearnReport, SaysWhereNoRecordingCouldBeLeftOut) {
  Diagnostics single, one_input;
  EXPECT_EQ(learnt_from(walks(1, 1), {}, &single).num_left_out, 0);
  EXPECT_THAT(said(single), HasSubstr("all pairs are from one recording of each style: none could be left out"));
  EXPECT_EQ(learnt_from(walks(1, 2), {}, &one_input).num_left_out, 0);
  EXPECT_THAT(said(one_input), HasSubstr("all pairs share one recording of the input style: none could be left out"));
}

}  // namespace
}  // namespace strut
