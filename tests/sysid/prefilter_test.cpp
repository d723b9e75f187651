// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/input_matrices.h>
#include <strut/sysid/prefilter.h>

namespace strut::sysid {
namespace {

TEST(Prefilter, KeepsTheSystem) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 3});
  for (const Experiment& clip : prefilter(clips, 0.7)) {
    EXPECT_EQ(clip.lead_in, 1);
    EXPECT_LT((simulate(truth, clip.input) - clip.output).norm(), 1e-12);
  }
}

/// Clips with noise that drifts: v[t] = 0.95 v[t-1] + white.
std::vector<Experiment> drifting_clips(const LtiSystem& system, unsigned seed) {
  auto clips = test::clips_of(system, {.count = 10, .frames = 100, .seed = seed});
  std::mt19937 random(seed + 100);
  for (Experiment& clip : clips) {
    FrameMatrix drift = test::white_noise(clip.num_frames(), clip.output.cols(), random);
    for (int t = 1; t < clip.num_frames(); ++t) drift.row(t) += 0.95 * drift.row(t - 1);
    clip.output += drift;
  }
  return clips;
}

TEST(Prefilter, EstimatesBetterWhereNoiseDrifts) {
  const LtiSystem truth = test::known_system();
  double plain = 0.0, filtered = 0.0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto clips = drifting_clips(truth, seed);
    const LtiSystem first = fit_input_matrices(truth.a(), truth.c(), clips);
    const double correlation = error_correlation(first, clips);
    EXPECT_NEAR(correlation, 0.95, 0.05);
    plain += test::markov_difference(first, truth);
    filtered += test::markov_difference(fit_input_matrices(truth.a(), truth.c(), prefilter(clips, correlation)), truth);
  }
  EXPECT_LT(filtered, 0.7 * plain);
}

TEST(Prefilter, LosesTheFrameBehindALeadIn) {
  const auto clips = test::clips_of(test::known_system(), {.count = 1, .frames = 5, .lead_in = 4});
  EXPECT_EQ(prefilter(clips, 0.5)[0].lead_in, 5);
  const auto brief = test::clips_of(test::known_system(), {.count = 1, .frames = 1});
  EXPECT_EQ(prefilter(brief, 0.5)[0].output, brief[0].output);
  EXPECT_EQ(prefilter(clips, 0.0)[0].output, clips[0].output);
}

TEST(ErrorCorrelation, IsNoneForWhiteAndForNoError) {
  const LtiSystem truth = test::known_system();
  EXPECT_LT(error_correlation(truth, test::clips_of(truth, {.noise = 1.0})), 0.1);
  EXPECT_EQ(error_correlation(truth, test::clips_of(truth, {})), 0.0);
}

TEST(Prefilter, RefusesWhatCannotBeMeant) {
  const auto clips = test::clips_of(test::known_system(), {.count = 1});
  EXPECT_THROW(prefilter(clips, 1.0), InvalidArgument);
  EXPECT_THROW(prefilter(clips, -0.1), InvalidArgument);
  EXPECT_THROW(prefilter({}, 0.5), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
