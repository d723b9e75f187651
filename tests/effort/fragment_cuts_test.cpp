// SPDX-License-Identifier: MIT
#include "effort/real_clips.h"
#include "support/walks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/fragment_cuts.h>
#include <strut/generate/walker.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/resample.h>

namespace strut::effort {
namespace {

using motion::FrameRange;

constexpr double kRate = 60.0;

/// A trunk with two arms of one bone.
std::shared_ptr<const Skeleton> body(double size) {
  std::vector<Joint> joints(6);
  joints[0] = {.name = "pelvis", .parent = -1};
  joints[1] = {.name = "chest", .parent = 0, .offset = {0.0, 0.5 * size, 0.0}};
  joints[2] = {.name = "shoulder", .parent = 1, .offset = {0.2 * size, 0.0, 0.0}};
  joints[3] = {.name = "hand", .parent = 2, .offset = {0.5 * size, 0.0, 0.0}};
  joints[4] = {.name = "other shoulder", .parent = 1, .offset = {-0.2 * size, 0.0, 0.0}};
  joints[5] = {.name = "other hand", .parent = 4, .offset = {-0.5 * size, 0.0, 0.0}};
  return std::make_shared<const Skeleton>(joints);
}

/// The first arm's angle over time, as a motion.
template <typename Angle>
Motion arm_motion(double seconds, const Angle& angle, double size = 1.0, double rate = kRate) {
  const auto skeleton = body(size);
  std::vector<Pose> frames;
  for (int t = 0; t < static_cast<int>(seconds * rate); ++t) {
    Pose pose = rest_pose(*skeleton);
    pose.translations[0] = {0.0, size, 0.0};
    pose.rotations[2] = math::exp_map({0.0, 0.0, angle(t / rate)});
    frames.push_back(pose);
  }
  return {skeleton, rate, frames};
}

double smooth_step(double x) {
  const double s = std::clamp(x, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

/// Still, up within a second, still, down within a second, still.
double raise(double time) {
  return smooth_step(time - 1.0) - smooth_step(time - 3.0);
}

void expect_near(const FrameRange& got, double begin, double end, double rate, double seconds) {
  EXPECT_NEAR(got.begin / rate, begin, seconds);
  EXPECT_NEAR(got.end / rate, end, seconds);
}

TEST(SuggestCuts, CutsAtPauses) {
  constexpr double kSlowStart = 0.15;  // [s]: what of a smooth movement is slower than a pause's limit
  const auto cuts = suggest_cuts(arm_motion(5.0, raise));
  ASSERT_EQ(cuts.size(), 2U);
  expect_near(cuts[0], 1.0, 2.0, kRate, kSlowStart);
  expect_near(cuts[1], 3.0, 4.0, kRate, kSlowStart);
}

TEST(SuggestCuts, DoesNotDependOnTheBodysSizeOrTheFrameRate) {
  const auto cuts = suggest_cuts(arm_motion(5.0, raise)), small = suggest_cuts(arm_motion(5.0, raise, 0.01));
  EXPECT_EQ(small, cuts);
  for (const double rate : {30.0, 120.0, 240.0}) {
    const auto other = suggest_cuts(arm_motion(5.0, raise, 1.0, rate));
    ASSERT_EQ(other.size(), cuts.size());
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      expect_near(other[k], cuts[k].begin / kRate, cuts[k].end / kRate, rate, 1.0 / 30.0);
    }
  }
}

TEST(SuggestCuts, CutsOneThereAndBackWhereItTurns) {
  const auto cuts =
      suggest_cuts(arm_motion(2.0, [](double time) { return smooth_step(time) - smooth_step(time - 1.0); }));
  ASSERT_EQ(cuts.size(), 2U);
  expect_near(cuts[0], 0.0, 1.0, kRate, 1.5 / kRate);
  expect_near(cuts[1], 1.0, 2.0, kRate, 1.5 / kRate);
}

TEST(SuggestCuts, CutsWhatRepeatsIntoWholeCycles) {
  const auto wave = [](double time) { return 0.5 * std::cos(std::numbers::pi * time); };
  const auto cuts = suggest_cuts(arm_motion(10.0, wave));
  ASSERT_EQ(cuts.size(), 5U);
  double begin = 0.0;
  for (const FrameRange& cut : cuts) {
    expect_near(cut, begin, begin + 2.0, kRate, 1.5 / kRate);
    begin += 2.0;
  }
}

TEST(SuggestCuts, BeginsCyclesWhereTheyBeginWhateverTheClipBeginsWith) {
  const auto wave = [](double time) { return 0.5 * std::cos(std::numbers::pi * time); };
  const Motion clip = arm_motion(12.0, wave);
  const auto whole = suggest_cuts(clip);
  for (const int skipped : {30, 60, 90}) {
    int cycles = 0;
    for (FrameRange cut : suggest_cuts(clip.slice(skipped, clip.num_frames()))) {
      if (cut.num_frames() < 100) continue;  // what is left of a cycle at an end
      cut.begin += skipped;
      ++cycles;
      EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), [&](const FrameRange& other) {
        return std::abs(other.begin - cut.begin) <= 1;
      })) << cut.begin;
    }
    EXPECT_GE(cycles, 4);
  }
}

TEST(SuggestCuts, FindsTheCyclesOfAGeneratedWalk) {
  constexpr double kSpread = 0.03;  // cycles: of the phase at which they begin
  const generate::Walk walk = generate::generate_walk({.duration = 12.0}, {}, 60.0);
  std::vector<double> phases;
  for (const FrameRange& cut : suggest_cuts(walk.motion)) {
    const double begin = walk.gait_phase[static_cast<std::size_t>(cut.begin)];
    const double end = walk.gait_phase[static_cast<std::size_t>(cut.end)];
    if (std::abs(end - begin - 1.0) < 0.1) phases.push_back(begin);
  }
  ASSERT_GE(phases.size(), 7U);
  for (const double phase : phases) {
    EXPECT_LT(std::abs(std::remainder(phase - phases.front(), 1.0)), kSpread) << phase;
  }
}

TEST(SuggestCuts, StaysWhenTheClipIsMovedAndTurnedOnTheGround) {
  const Motion walk = strut::test::short_walk(0.2, 6.0);
  EXPECT_EQ(suggest_cuts(motion::moved(walk, {2.0, 0.0, -1.0}, 2.0)), suggest_cuts(walk));
}

TEST(SuggestCuts, KeepsToTheDurationsAsked) {
  const Motion walk = strut::test::short_walk(0.2, 9.0);
  const CutOptions options{.min_duration = 0.3, .max_duration = 0.8};
  const auto cuts = suggest_cuts(walk, options);
  ASSERT_FALSE(cuts.empty());
  int last = 0;
  for (const FrameRange& cut : cuts) {
    EXPECT_GE(cut.begin, last);
    EXPECT_GE(cut.num_frames(), 0.3 * walk.frame_rate());
    EXPECT_LE(cut.num_frames(), 0.8 * walk.frame_rate());
    last = cut.end;
  }
  EXPECT_LE(last, walk.num_frames());
}

TEST(SuggestCuts, OfWhatStandsStillAreNone) {
  const Motion walk = strut::test::short_walk(0.0, 1.0);
  EXPECT_TRUE(suggest_cuts(strut::test::held(walk, 90)).empty());
  EXPECT_TRUE(suggest_cuts(walk.slice(0, 0)).empty());
  EXPECT_TRUE(suggest_cuts(walk.slice(0, 1)).empty());
}

TEST(SuggestCuts, RefusesOptionsThatAreNone) {
  const Motion walk = strut::test::short_walk(0.0, 1.0);
  EXPECT_THROW(suggest_cuts(walk, {.min_duration = 0.0}), InvalidArgument);
  EXPECT_THROW(suggest_cuts(walk, {.min_duration = std::nan("")}), InvalidArgument);
  EXPECT_THROW(suggest_cuts(walk, {.min_duration = 0.5, .max_duration = 0.9}), InvalidArgument);
  EXPECT_THROW(suggest_cuts(walk, {.turn_depth = 0.0}), InvalidArgument);
  EXPECT_THROW(suggest_cuts(walk, {.turn_depth = 1.0}), InvalidArgument);
  EXPECT_THROW(suggest_cuts(walk, {.pause_speed = -0.1}), InvalidArgument);
  EXPECT_THROW(suggest_cuts(walk, {.min_pause = -1.0}), InvalidArgument);
}

TEST(SuggestCuts, CutsARaisedHandIntoUpAndDown) {
  STRUT_REQUIRE_REAL_DATA();
  for (const char* take : {"active_001", "elderly_001", "feminine_004", "normal_010"}) {
    EXPECT_EQ(suggest_cuts(test::real_clip(std::string("raise-up-right-hand_") + take)).size(), 2U) << take;
  }
}

}  // namespace
}  // namespace strut::effort
