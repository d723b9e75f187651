// SPDX-License-Identifier: MIT
#include "support/stepper.h"

#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/learn/clip_pair.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::learn {
namespace {

Motion walk(double stride, double turning = 0.0, double cycle_time = 1.0, int cycles = 5) {
  return test::stepping_body({.cycles = cycles, .cycle_time = cycle_time, .stride = stride, .turning = turning}).motion;
}

/// A standing body that nods its chest for `duration` [s], after and before standing still for `still` [s].
Motion nod(double duration, double still = 1.0, double amplitude = 0.5) {
  const Motion body = walk(1.0);
  const int count = static_cast<int>((duration + 2 * still) * 30.0);
  std::vector<Pose> frames(static_cast<std::size_t>(count), body.frame(0));
  for (int t = 0; t < count; ++t) {
    const double time = t / 30.0 - still;
    if (time < 0.0 || time > duration) continue;
    // The pelvis turns the chest and the feet alike; only the chest's offset moves here.
    const double angle = amplitude * std::sin(2.0 * 3.14159265358979 * time);
    frames[static_cast<std::size_t>(t)].translations[1] = math::exp_map({angle, 0, 0}) * body.frame(0).translations[1];
  }
  return {body.shared_skeleton(), 30.0, frames};
}

TEST(SlopeLimit, WidensWithTheDifferenceOfDurations) {
  EXPECT_EQ(slope_limit_for(1.0, 1.0), 2);
  EXPECT_EQ(slope_limit_for(1.0, 1.79), 2);
  EXPECT_EQ(slope_limit_for(1.81, 1.0), 3);
  EXPECT_EQ(slope_limit_for(1.0, 2.99), 3);
  EXPECT_EQ(slope_limit_for(3.01, 1.0), 0);
  EXPECT_THROW(slope_limit_for(0.0, 1.0), InvalidArgument);
}

TEST(MovingPart, LeavesOutStandingStill) {
  const FrameRange part = moving_part(nod(2.0, 1.0));
  EXPECT_NEAR(part.begin, 30 - 3, 3);  // a tenth of a second is kept either side
  EXPECT_NEAR(part.end, 90 + 3, 4);
}

TEST(MovingPart, OfABodyThatNeverMovesIsAllOfIt) {
  EXPECT_EQ(moving_part(nod(2.0, 1.0, 0.0)), (FrameRange{0, 120}));
}

TEST(Pairing, CutsWalksIntoCyclesAndKeepsTheRestWhole) {
  const auto stretches = stretches_of({walk(1.2), nod(2.0)});
  ASSERT_EQ(stretches.size(), 9U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(stretches[i].kind, PairKind::kGaitCycle);
    EXPECT_EQ(stretches[i].clip, 0);
  }
  EXPECT_EQ(stretches[8].kind, PairKind::kWhole);
  EXPECT_EQ(stretches_of({walk(1.2)}, {.whole = true}).size(), 1U);
}

TEST(Pairing, GivesEveryCycleItsNearestOfTheSameFootByTurning) {
  const std::vector<Motion> inputs = {walk(1.0, 0.0), walk(1.0, 0.6), walk(1.0, -0.6)};
  const std::vector<Motion> outputs = {walk(0.6, -0.5), walk(0.6, 0.0), walk(0.6, 0.5)};
  const Pairing pairing = find_pairs(inputs, outputs, {.neighbours = 2});
  EXPECT_EQ(pairing.pairs.size(), 2 * pairing.inputs.size());
  EXPECT_TRUE(pairing.refused.empty());
  EXPECT_TRUE(pairing.uncovered.empty());
  const int expected[] = {1, 2, 0};
  for (const ClipPair& pair : pairing.pairs) {
    EXPECT_EQ(pair.output_clip, expected[pair.input_clip]);
    EXPECT_EQ(pair.slope_limit, 2);
    EXPECT_NEAR(pair.input.duration, pair.input_frames.num_frames() / 30.0, 1e-9);
    EXPECT_NEAR(pair.output.speed, 0.6, 0.05);
  }
}

TEST(Pairing, MatchesSpeedsRelativeToEachStylesOwn) {
  // The slow style's fastest walk is slower than the quick style's slowest: ranks are what is alike.
  const std::vector<Motion> inputs = {walk(1.0), walk(1.2), walk(1.4)};
  const std::vector<Motion> outputs = {walk(0.9), walk(0.7), walk(0.5)};
  const int expected[] = {2, 1, 0};
  for (const ClipPair& pair : find_pairs(inputs, outputs, {.neighbours = 1}).pairs) {
    EXPECT_EQ(pair.output_clip, expected[pair.input_clip]);
  }
}

TEST(Pairing, DistanceIsTurningOverItsScaleWhereSpeedsAgree) {
  const Pairing pairing = find_pairs({walk(1.0, 0.35)}, {walk(1.0, 0.0)}, {.neighbours = 1});
  ASSERT_FALSE(pairing.pairs.empty());
  for (const ClipPair& pair : pairing.pairs) {
    const double turning = (pair.input.turning - pair.output.turning) / 0.35;
    EXPECT_GE(pair.distance, std::abs(turning) - 1e-9);
    EXPECT_NEAR(pair.distance, 1.0, 0.25);  // speeds differ only by cutting at whole frames
  }
}

TEST(Pairing, RefusesWhatTurnsOtherwiseAndSaysSo) {
  Diagnostics diagnostics;
  const Pairing pairing = find_pairs({walk(1.0, 1.5), walk(1.0)}, {walk(1.0)}, {}, &diagnostics);
  for (const ClipPair& pair : pairing.pairs) EXPECT_EQ(pair.input_clip, 1);
  ASSERT_FALSE(pairing.refused.empty());
  EXPECT_NE(pairing.refused[0].reason.find("one turns by 8"), std::string::npos) << pairing.refused[0].reason;
  EXPECT_EQ(pairing.uncovered.size(), 8U);
  ASSERT_EQ(diagnostics.entries().size(), 1U);
  EXPECT_NE(diagnostics.entries()[0].message.find("8 of 16 stretches"), std::string::npos);
}

TEST(Pairing, RefusesDurationsThatCannotBeAligned) {
  const Pairing pairing = find_pairs({nod(1.0, 0.2)}, {nod(4.0, 0.2)});
  EXPECT_TRUE(pairing.pairs.empty());
  ASSERT_EQ(pairing.refused.size(), 1U);
  EXPECT_NE(pairing.refused[0].reason.find("times as long"), std::string::npos);
}

TEST(Pairing, WidensTheSlopeLimitOfUnequalDurations) {
  const Pairing pairing = find_pairs({nod(2.0)}, {nod(5.0)});
  ASSERT_EQ(pairing.pairs.size(), 1U);
  EXPECT_EQ(pairing.pairs[0].slope_limit, 3);
  EXPECT_EQ(pairing.pairs[0].kind, PairKind::kWhole);
}

TEST(Pairing, PairsLongTakesWithLongTakes) {
  const std::vector<Motion> inputs = {nod(2.0), nod(3.0), nod(4.0)};
  const std::vector<Motion> outputs = {nod(5.0), nod(4.0), nod(3.0)};
  const int expected[] = {2, 1, 0};
  for (const ClipPair& pair : find_pairs(inputs, outputs, {.neighbours = 1}).pairs) {
    EXPECT_EQ(pair.output_clip, expected[pair.input_clip]);
  }
}

TEST(Pairing, LeavesOutABrokenOffRecording) {
  Diagnostics diagnostics;
  const Pairing pairing = find_pairs({nod(4.0)}, {nod(4.0), nod(4.2), nod(0.5, 0.0), nod(3.9)}, {}, &diagnostics);
  EXPECT_EQ(pairing.outputs.size(), 3U);
  ASSERT_FALSE(diagnostics.entries().empty());
  EXPECT_EQ(diagnostics.entries()[0].where, "output clip 2");
}

TEST(Pairing, DoesNotMixWalksWithWhatStays) {
  Diagnostics diagnostics;
  const Pairing pairing = find_pairs({walk(1.0), nod(3.0)}, {nod(3.0)}, {}, &diagnostics);
  ASSERT_EQ(pairing.pairs.size(), 1U);
  EXPECT_EQ(pairing.pairs[0].input_clip, 1);
  ASSERT_EQ(diagnostics.entries().size(), 1U);
  EXPECT_EQ(diagnostics.entries()[0].message, "input clips walk, but no output clip does");
}

TEST(Pairing, DoesNotDependOnWhereClipsStand) {
  const std::vector<Motion> inputs = {walk(1.0, 0.3), walk(1.2)};
  const std::vector<Motion> outputs = {walk(0.6), walk(0.7, 0.4)};
  const std::vector<Motion> elsewhere = {motion::moved(outputs[0], {4, 0, 4}, 1.0),
                                         motion::moved(outputs[1], {0, 0, 9}, -2.0)};
  const auto here = find_pairs(inputs, outputs).pairs;
  const auto there = find_pairs(inputs, elsewhere).pairs;
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i].distance, there[i].distance, 1e-6);
}

TEST(Pairing, RefusesBadOptionsAndNoClips) {
  const std::vector<Motion> clips = {nod(1.0)};
  EXPECT_THROW(find_pairs({}, clips), InvalidArgument);
  EXPECT_THROW(find_pairs(clips, {}), InvalidArgument);
  EXPECT_THROW(find_pairs(clips, clips, {.neighbours = 0}), InvalidArgument);
  EXPECT_THROW(find_pairs(clips, clips, {.turning_scale = 0.0}), InvalidArgument);
  EXPECT_THROW(find_pairs(clips, clips, {.speed_weight = -1.0}), InvalidArgument);
}

}  // namespace
}  // namespace strut::learn
