// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <limits>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/identify.h>

namespace strut::sysid {
namespace {

constexpr double kRecovered = 1e-6;  // of Markov parameters of size one, without noise

std::vector<int> each_its_own(std::size_t count) {
  std::vector<int> groups;
  for (std::size_t k = 0; k < count; ++k) groups.push_back(static_cast<int>(k));
  return groups;
}

class IdentifyWeighting : public testing::TestWithParam<Weighting> {};
INSTANTIATE_TEST_SUITE_P(All, IdentifyWeighting,
                         testing::Values(Weighting::kN4sid, Weighting::kMoesp, Weighting::kCva));

TEST_P(IdentifyWeighting, RecoversAKnownSystem) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {});
  const Identified found = identify(clips, each_its_own(clips.size()), {.weighting = GetParam()});
  EXPECT_EQ(found.system.num_states(), 4);
  EXPECT_LT(test::markov_difference(found.system, truth), kRecovered);
  EXPECT_GT(found.fit, 99.999);
}

TEST_P(IdentifyWeighting, RecoversAKnownSystemFromCutsOfLongerMotion) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.lead_in = 20, .initial_state = 3.0});
  const LtiSystem found = identify_order(clips, 4, {.weighting = GetParam()});
  EXPECT_LT(test::markov_difference(found, truth), 0.05);  // what an initial state 20 frames ago leaves
  auto unled = test::clips_of(truth, {.initial_state = 3.0});
  EXPECT_LT(test::markov_difference(identify_order(unled, 4, {.weighting = GetParam()}), truth), kRecovered);
}

TEST_P(IdentifyWeighting, FindsOrderAndSystemUnderNoise) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 60, .noise = 0.2});
  const Identified found = identify(clips, each_its_own(clips.size()), {.weighting = GetParam()});
  EXPECT_EQ(found.system.num_states(), 4);
  EXPECT_LT(test::markov_difference(found.system, truth), 0.1);
}

TEST(Identify, TakesAStaticMapForWhatItIs) {
  std::mt19937 random(3);
  Eigen::MatrixXd gain(2, 3);
  gain << 1.0, -0.5, 0.25, 0.0, 2.0, -1.0;
  std::vector<Experiment> clips;
  for (int k = 0; k < 20; ++k) {
    const FrameMatrix input = test::white_noise(40, 3, random);
    clips.push_back({input, input * gain.transpose() + 0.1 * test::white_noise(40, 2, random)});
  }
  const Identified found = identify(clips, each_its_own(clips.size()));
  EXPECT_EQ(found.system.num_states(), 0);
  EXPECT_NEAR((found.system.d() - gain).cwiseAbs().maxCoeff(), 0.0, 0.02);  // noise 0.1 over 800 frames, thrice over
}

/// Whatever went in: a finite, stable system of the clips' widths.
void expect_usable(const Identified& found, const std::vector<Experiment>& clips) {
  EXPECT_EQ(found.system.num_inputs(), clips.front().input.cols());
  EXPECT_EQ(found.system.num_outputs(), clips.front().output.cols());
  EXPECT_LE(found.system.spectral_radius(), IdentifyOptions().max_radius + 1e-9);
  EXPECT_TRUE(std::isfinite(found.fit));
}

TEST(Identify, IgnoresInputsThatNeverMoveOrRepeatOthers) {
  const LtiSystem truth = test::known_system();
  auto clips = test::clips_of(truth, {});
  for (Experiment& clip : clips) {
    FrameMatrix more(clip.num_frames(), 5);
    more << clip.input, 2.0 * clip.input.col(0) - clip.input.col(1), FrameMatrix::Zero(clip.num_frames(), 1),
        clip.input.col(1);
    clip.input = more;
  }
  const Identified found = identify(clips, each_its_own(clips.size()));
  expect_usable(found, clips);
  EXPECT_GT(found.fit, 99.999);
  EXPECT_EQ(found.system.d().col(3).norm(), 0.0);
}

TEST(Identify, GivesAnOutputThatNeverMovesNothing) {
  auto clips = test::clips_of(test::known_system(), {});
  for (Experiment& clip : clips) clip.output.col(1).setZero();
  const Identified found = identify(clips, each_its_own(clips.size()));
  expect_usable(found, clips);
  EXPECT_GT(found.fit, 99.999);
  for (const Experiment& clip : clips) {
    EXPECT_LT(simulate(found.system, clip.input).col(1).cwiseAbs().maxCoeff(), kRecovered);
  }
}

TEST(Identify, StandsPeriodicAndConstantInputs) {
  const LtiSystem truth(0.7 * Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Ones(1, 3), Eigen::MatrixXd::Ones(2, 1),
                        Eigen::MatrixXd::Zero(2, 3));
  std::mt19937 random(5);
  std::vector<Experiment> clips;
  for (int k = 0; k < 12; ++k) {
    FrameMatrix input(50, 3);
    for (int t = 0; t < 50; ++t) input.row(t) << std::sin(0.3 * t + k), std::cos(0.3 * t + k), 1.0;
    clips.push_back({input, simulate(truth, input), 20});
  }
  const Identified found = identify(clips, each_its_own(clips.size()));
  expect_usable(found, clips);
  EXPECT_GT(found.fit, 99.0);
}

TEST(Identify, DoesNotChangeWithUnits) {
  const auto clips = test::clips_of(test::known_system(), {.count = 30, .noise = 0.3});
  auto other_units = clips;
  for (Experiment& clip : other_units) {
    clip.input.col(0) *= 1e6;
    clip.output.col(2) *= 1e-5;
  }
  const Identified found = identify(clips, each_its_own(clips.size()));
  const Identified same = identify(other_units, each_its_own(clips.size()));
  EXPECT_EQ(found.system.num_states(), same.system.num_states());
  EXPECT_NEAR(found.fit, same.fit, 1e-6);
}

TEST(Identify, StandsClipsOfEveryLength) {
  const LtiSystem truth = test::known_system();
  for (const int frames : {1, 2, 3, 5, 8, 13, 21, 34}) {
    for (const int count : {1, 2, 3, 10}) {
      const auto clips = test::clips_of(truth, {.count = count, .frames = frames, .noise = 0.1});
      expect_usable(identify(clips, each_its_own(clips.size())), clips);
      expect_usable(identify(clips, std::vector<int>(clips.size(), 7)), clips);
      expect_usable(identify(clips, each_its_own(clips.size()),
                             {.input_matrices = InputMatrices::kStates, .refine_iterations = 2}),
                    clips);
    }
  }
}

TEST(Identify, SaysWhatItHadToDoWithout) {
  const LtiSystem truth = test::known_system();
  Diagnostics diagnostics;
  const auto short_clips = test::clips_of(truth, {.count = 60, .frames = 16});
  EXPECT_EQ(identify(short_clips, each_its_own(60), {}, &diagnostics).system.num_states(), 4);
  ASSERT_EQ(diagnostics.entries().size(), 1u);
  EXPECT_EQ(diagnostics.entries()[0].message, "short clips: 7 block rows instead of 10");
  const auto too_short = test::clips_of(truth, {.count = 60, .frames = 3});
  EXPECT_EQ(identify(too_short, each_its_own(60), {}, &diagnostics).system.num_states(), 0);
  EXPECT_EQ(diagnostics.entries()[1].severity, Severity::kWarning);
  auto silent = too_short;
  for (Experiment& clip : silent) clip.input.setZero();
  expect_usable(identify(silent, each_its_own(60), {}, &diagnostics), silent);
  EXPECT_EQ(diagnostics.entries()[2].message, "no input ever differs from zero; the output will be zero");
}

TEST(Identify, ClipsAnUnstableSystem) {
  const LtiSystem unstable(1.05 * Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Ones(1, 1),
                           Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1));
  const auto clips = test::clips_of(unstable, {.count = 10, .frames = 80});
  for (const double radius : {0.9, 0.98}) {
    EXPECT_LE(identify_order(clips, 3, {.max_radius = radius}).spectral_radius(), radius + 1e-9);
  }
}

TEST_P(IdentifyWeighting, RecoversAKnownSystemFromStatesAndByTheGap) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.initial_state = 2.0});
  const Identified found =
      identify(clips, each_its_own(clips.size()),
               {.weighting = GetParam(), .input_matrices = InputMatrices::kStates, .order_rule = OrderRule::kGap});
  EXPECT_EQ(found.system.num_states(), 4);
  EXPECT_LT(test::markov_difference(found.system, truth), kRecovered);
}

TEST(Identify, TakesAFixedOrderForAnOrder) {
  const auto clips = test::clips_of(test::known_system(), {.noise = 0.5});
  const Identified found =
      identify(clips, each_its_own(clips.size()), {.max_order = 2, .order_rule = OrderRule::kFixed});
  EXPECT_EQ(found.system.num_states(), 2);
  EXPECT_EQ(found.fit, found.left_out_fit[2]);
}

TEST(Identify, KeepsARefinementThatHelpsClipsLeftOut) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 12, .noise = 0.5});
  const Identified plain = identify(clips, each_its_own(clips.size()), {.order_rule = OrderRule::kFixed});
  const Identified found =
      identify(clips, each_its_own(clips.size()), {.order_rule = OrderRule::kFixed, .refine_iterations = 10});
  EXPECT_EQ(found.left_out_fit, plain.left_out_fit);
  ASSERT_EQ(found.refined_fit.size(), plain.left_out_fit.size());
  EXPECT_TRUE(plain.refined_fit.empty());
  EXPECT_EQ(found.is_refined, found.refined_fit[6] > found.left_out_fit[6]);
  EXPECT_EQ(found.fit, std::max(found.refined_fit[6], found.left_out_fit[6]));
  EXPECT_GT(found.refined_fit[2], found.left_out_fit[2]) << "too few states: A and C of the subspace are not the best";
  expect_usable(found, clips);
}

TEST(Identify, RefusesWhatCannotBeMeant) {
  const auto clips = test::clips_of(test::known_system(), {.count = 4});
  const auto groups = each_its_own(4);
  EXPECT_THROW(identify({}, {}), InvalidArgument);
  EXPECT_THROW(identify(clips, {1, 2}), InvalidArgument);
  EXPECT_THROW(identify(clips, groups, {.max_order = -1}), InvalidArgument);
  EXPECT_THROW(identify(clips, groups, {.block_rows = 1}), InvalidArgument);
  EXPECT_THROW(identify(clips, groups, {.max_radius = 1.0}), InvalidArgument);
  EXPECT_THROW(identify(clips, groups, {.order_tolerance = -0.5}), InvalidArgument);
  EXPECT_THROW(identify(clips, groups, {.num_folds = 1}), InvalidArgument);
  EXPECT_THROW(identify(clips, groups, {.refine_iterations = -1}), InvalidArgument);
  auto broken = clips;
  broken[2].output(5, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(identify(broken, groups), InvalidArgument);
  broken = clips;
  broken[1].lead_in = broken[1].num_frames();
  EXPECT_THROW(identify(broken, groups), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
