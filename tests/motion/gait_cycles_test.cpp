// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/stepper.h"

#include <cmath>

#include <gtest/gtest.h>

#include <strut/io/bvh.h>
#include <strut/motion/gait_cycles.h>
#include <strut/motion/kinematics.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::motion {
namespace {

constexpr double kOneFrame = 1.0 / 30.0;  // what cutting at whole frames may cost [s]
constexpr double kRounding = 0.03;        // the same, as a share of a cycle of one second

std::vector<GaitCycle> cycles_of(const test::SteppingBody& body, Diagnostics* diagnostics = nullptr) {
  return gait_cycles(body.motion, *motion::find_legs(body.motion), body.footplants, diagnostics);
}

TEST(GaitCycles, AreCutAtTheOnsetsOfEitherFoot) {
  const auto body = test::stepping_body({.cycles = 4});
  const auto cycles = cycles_of(body);
  ASSERT_EQ(cycles.size(), 6U);  // four onsets of each foot
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    EXPECT_EQ(cycles[i].foot, static_cast<int>(i % 2));
    EXPECT_NEAR(cycles[i].duration, 1.0, kOneFrame + 1e-9);
    EXPECT_NEAR(cycles[i].speed, 1.2, 1.2 * kRounding);
    EXPECT_NEAR(cycles[i].turning, 0.0, 1e-9);
  }
}

TEST(GaitCycles, KnowSpeedAlongTheArcAndTurning) {
  const auto body = test::stepping_body({.cycles = 5, .stride = 1.0, .turning = -1.4});
  const auto cycles = cycles_of(body);
  ASSERT_EQ(cycles.size(), 8U);
  for (const GaitCycle& cycle : cycles) {
    EXPECT_NEAR(cycle.turning, -1.4, 1.4 * kRounding * 1.2);
    EXPECT_NEAR(cycle.speed, 1.0, 1e-6);  // of the pelvis, which goes along a circle at a constant speed
  }
}

TEST(GaitCycles, AreTheSameWhereverTheClipStands) {
  const auto body = test::stepping_body({.turning = 0.5});
  const auto legs = *motion::find_legs(body.motion);
  const auto here = gait_cycles(body.motion, legs, body.footplants);
  const auto there = gait_cycles(motion::moved(body.motion, {5, 0, 1}, 2.9), legs, body.footplants);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(here[i].frames, there[i].frames);
    EXPECT_NEAR(here[i].turning, there[i].turning, 1e-9);
    EXPECT_NEAR(here[i].speed, there[i].speed, 1e-9);
  }
}

TEST(GaitCycles, LeaveOutAHalt) {
  Diagnostics diagnostics;
  const auto body = test::stepping_body({.cycles = 6, .pause_after = 3.0, .pause = 1.2});
  const auto cycles = cycles_of(body, &diagnostics);
  EXPECT_EQ(cycles.size(), 8U);  // of ten, the two that hold the halt are gone
  for (const GaitCycle& cycle : cycles) EXPECT_LT(cycle.duration, 1.1);
  ASSERT_EQ(diagnostics.entries().size(), 2U);
  EXPECT_NE(diagnostics.entries()[0].message.find("a halt"), std::string::npos);
}

TEST(GaitCycles, LeaveOutWhatNoGaitHas) {
  const auto body = test::stepping_body({.cycles = 6});
  auto footplants = body.footplants;
  // A landing of the right foot goes missing: its cycle doubles, and two left cycles lose their other foot.
  const auto right = std::find_if(footplants.begin(), footplants.end(),
                                  [](const auto& plant) { return plant.foot == 1 && plant.begin > 60; });
  footplants.erase(right);
  Diagnostics diagnostics;
  const auto cycles = gait_cycles(body.motion, *motion::find_legs(body.motion), footplants, &diagnostics);
  EXPECT_EQ(cycles.size(), 7U);
  ASSERT_EQ(diagnostics.entries().size(), 2U);
  EXPECT_NE(diagnostics.entries()[0].message.find("the other foot does not come down in it"), std::string::npos);
  EXPECT_NE(diagnostics.entries()[1].message.find("the other foot comes down 2 times in it"), std::string::npos);
}

TEST(GaitCycles, OfStandingFeetAreNone) {
  const auto body = test::stepping_body({});
  const std::vector<motion::Footplant> standing = {{0, 0, 100}, {1, 0, 100}};
  EXPECT_TRUE(gait_cycles(body.motion, *motion::find_legs(body.motion), standing).empty());
}

TEST(GaitCycles, OfARealWalkAreRegular) {
  STRUT_REQUIRE_REAL_DATA();
  const Motion clip = read_bvh(test::real_data() + "/bandai-namco/dataset-2_walk-turn-left_elderly_002.bvh").motion;
  const auto legs = *motion::find_legs(clip);
  const auto cycles = gait_cycles(clip, legs, postprocess::detect_footplants(clip, legs));
  ASSERT_GE(cycles.size(), 8U);
  double sharpest = 0.0;
  for (const GaitCycle& cycle : cycles) {
    EXPECT_NEAR(cycle.duration, 1.08, 0.1);
    EXPECT_NEAR(cycle.speed, 0.57, 0.15);
    sharpest = std::max(sharpest, cycle.turning);
  }
  EXPECT_GT(sharpest, 0.6);  // to the left
}

}  // namespace
}  // namespace strut::motion
