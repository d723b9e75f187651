// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/combine.h>

namespace strut::sysid {
namespace {

std::vector<int> each_its_own(std::size_t count) {
  std::vector<int> groups;
  for (std::size_t k = 0; k < count; ++k) groups.push_back(static_cast<int>(k));
  return groups;
}

/// The known system with its slow pole faster: it is forgotten within the impulse responses' taps.
LtiSystem quick_system() {
  const LtiSystem known = test::known_system();
  Eigen::MatrixXd a = known.a();
  a(2, 2) = 0.6;
  return {a, known.b(), known.c(), known.d()};
}

/// Clips with noise that drifts from frame to frame.
std::vector<Experiment> drifting_clips(const LtiSystem& system, int count) {
  auto clips = test::clips_of(system, {.count = count, .frames = 50});
  std::mt19937 random(12);
  for (Experiment& clip : clips) {
    FrameMatrix drift = test::white_noise(clip.num_frames(), clip.output.cols(), random);
    for (int t = 1; t < clip.num_frames(); ++t) drift.row(t) += 0.9 * drift.row(t - 1);
    clip.output += 0.7 * drift;
  }
  return clips;
}

const CombineOptions kQuick{.identification = {.max_order = 4, .starts = Starts::kEvery, .refine_iterations = 3}};

TEST(IdentifyCombined, IsAtLeastAsGoodOnClipsLeftOutAsEveryPart) {
  const LtiSystem truth = quick_system();
  const auto clips = drifting_clips(truth, 12);
  const Combined found = identify_combined(clips, each_its_own(clips.size()), kQuick);
  ASSERT_EQ(found.fit_alone.size(), 5u);
  EXPECT_GE(found.fit, *std::max_element(found.fit_alone.begin(), found.fit_alone.end()) - kQuick.tolerance);
  EXPECT_GT(found.error_correlation, 0.5);
  EXPECT_LT(found.system.spectral_radius(), 1.0);
  EXPECT_LE(found.system.num_states(), kQuick.max_states);
  const auto fresh = test::clips_of(truth, {.count = 10, .seed = 77});
  EXPECT_GT(simulated_fit(found.system, fresh), simulated_fit(found.subspace.system, fresh) - 1.0);
}

TEST(IdentifyCombined, TakesOneEstimateWhereThereIsNothingToGain) {
  const LtiSystem truth = quick_system();
  const auto clips = test::clips_of(truth, {.count = 10});
  const Combined found = identify_combined(clips, each_its_own(clips.size()), kQuick);
  EXPECT_EQ(found.estimates, std::vector<Estimate>{Estimate::kSubspace});
  EXPECT_LT(test::markov_difference(found.system, truth), 1e-6);
}

TEST(IdentifyCombined, LeavesRecordsAndSlowPolesToTheSubspace) {
  const LtiSystem slow(0.99 * Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Ones(1, 1),
                       Eigen::MatrixXd::Zero(1, 1));
  const auto record = test::clips_of(quick_system(), {.count = 1, .frames = 200, .noise = 0.5});
  const auto slow_clips = test::clips_of(slow, {.count = 6, .frames = 80, .noise = 0.1});
  CombineOptions options = kQuick;
  options.identification.max_radius = 0.999;
  for (const auto& clips : {record, slow_clips}) {
    const Combined found = identify_combined(clips, each_its_own(clips.size()), options);
    EXPECT_EQ(found.estimates, std::vector<Estimate>{Estimate::kSubspace});
    EXPECT_EQ(found.fit, found.subspace.fit);
    EXPECT_EQ(found.fit_alone.size(), 1u);
  }
}

TEST(IdentifyCombined, StandsClipsThatSayLittle) {
  for (const int frames : {1, 2, 5, 12}) {
    for (const int count : {1, 2, 3}) {
      auto clips = test::clips_of(quick_system(), {.count = count, .frames = frames, .noise = 0.1});
      EXPECT_TRUE(std::isfinite(identify_combined(clips, each_its_own(clips.size()), kQuick).fit));
      for (Experiment& clip : clips) clip.input.col(1) = clip.input.col(0);
      EXPECT_TRUE(std::isfinite(identify_combined(clips, std::vector<int>(clips.size(), 3), kQuick).fit));
      for (Experiment& clip : clips) clip.input.setZero();
      EXPECT_EQ(identify_combined(clips, each_its_own(clips.size()), kQuick).system.d().norm(), 0.0);
    }
  }
}

TEST(IdentifyCombined, RefusesWhatCannotBeMeant) {
  const auto clips = test::clips_of(quick_system(), {.count = 4});
  EXPECT_THROW(identify_combined({}, {}), InvalidArgument);
  EXPECT_THROW(identify_combined(clips, {1}), InvalidArgument);
  EXPECT_THROW(identify_combined(clips, each_its_own(4), {.tolerance = -1.0}), InvalidArgument);
}

TEST(Identify, MayBeJudgedFromEveryStart) {
  const auto clips = test::clips_of(quick_system(), {.count = 1, .frames = 300, .noise = 0.3, .initial_state = 5.0});
  const Identified from_rest = identify(clips, {0}, {.max_radius = 0.99});
  const Identified from_every = identify(clips, {0}, {.max_radius = 0.99, .starts = Starts::kEvery});
  EXPECT_NE(from_rest.fit, from_every.fit);
  EXPECT_EQ(from_every.system.num_states(), 4);
}

}  // namespace
}  // namespace strut::sysid
