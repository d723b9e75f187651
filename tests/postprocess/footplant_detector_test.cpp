// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/stepper.h"

#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::postprocess {
namespace {

// Half a velocity window either way: what speed alone can tell of the moment of landing [s].
constexpr double kOnsetTolerance = 2.0 / 30.0;

std::vector<motion::Footplant> detected(const Motion& clip) {
  const auto legs = motion::find_legs(clip);
  EXPECT_TRUE(legs.has_value());
  return detect_footplants(clip, *legs);
}

void expect_same_plants(const test::SteppingBody& body, const char* what) {
  const auto found = detected(body.motion);
  ASSERT_EQ(found.size(), body.footplants.size()) << what;
  const double frames = kOnsetTolerance * body.motion.frame_rate() + 1e-9;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].foot, body.footplants[i].foot) << what;
    EXPECT_NEAR(found[i].begin, body.footplants[i].begin, frames) << what << ", plant " << i;
    EXPECT_NEAR(found[i].end, body.footplants[i].end, frames) << what << ", plant " << i;
  }
}

TEST(FootplantDetector, FindsWalkingFeet) {
  expect_same_plants(test::stepping_body({}), "walk");
}

TEST(FootplantDetector, FindsRunningFeet) {
  expect_same_plants(test::stepping_body({.cycle_time = 0.7, .stance = 0.35, .stride = 2.5}), "run");
}

TEST(FootplantDetector, FindsFeetThatAreDraggedSlowly) {
  expect_same_plants(test::stepping_body({.cycle_time = 1.4, .stance = 0.75, .stride = 0.4, .drag = 1.0}), "shuffle");
}

TEST(FootplantDetector, DoesNotDependOnTheFrameRate) {
  for (const double rate : {24.0, 30.0, 60.0, 120.0}) {
    expect_same_plants(test::stepping_body({.frame_rate = rate}), std::to_string(rate).c_str());
  }
}

TEST(FootplantDetector, DoesNotDependOnTheBodysSize) {
  // Speeds scale with the body here: a child and a giant take the same time for a cycle.
  expect_same_plants(test::stepping_body({.stride = 0.6, .scale = 0.5}), "child");
  expect_same_plants(test::stepping_body({.stride = 2.4, .scale = 2.0}), "giant");
}

TEST(FootplantDetector, DoesNotSeeWhereAClipStandsOrHowHighTheGroundIs) {
  const auto body = test::stepping_body({});
  EXPECT_EQ(detected(body.motion), detected(motion::moved(body.motion, {3.0, 0.7, -2.0}, 1.0)));
}

TEST(FootplantDetector, KeepsAStandingBodysFeetDown) {
  const auto body = test::stepping_body({});
  std::vector<Pose> frames(60, body.motion.frame(0));
  for (std::size_t t = 0; t < frames.size(); ++t) {
    frames[t].translations[0].x() += 0.002 * std::sin(0.7 * static_cast<double>(t));  // sway, with the feet
  }
  const auto found = detected(Motion(body.motion.shared_skeleton(), 30.0, frames));
  const std::vector<motion::Footplant> whole = {{0, 0, 60}, {1, 0, 60}};
  EXPECT_EQ(found, whole);
}

TEST(FootplantDetector, ClosesAGapInWhichTheFootStays) {
  auto body = test::stepping_body({});
  std::vector<Pose> frames = body.motion.frames();
  const auto& plant = body.footplants[1];
  const auto glitch = static_cast<std::size_t>((plant.begin + plant.end) / 2);
  for (const std::size_t joint : {4U, 5U}) frames[glitch].translations[joint].y() += 0.1;
  expect_same_plants({Motion(body.motion.shared_skeleton(), 30.0, frames), body.footplants}, "glitch");
}

TEST(FootplantDetector, RefusesThresholdsThatCross) {
  const auto body = test::stepping_body({});
  const auto legs = *motion::find_legs(body.motion);
  EXPECT_THROW(detect_footplants(body.motion, legs, {.landing_speed = 0.3, .leaving_speed = 0.2}), InvalidArgument);
  EXPECT_THROW(detect_footplants(body.motion, legs, {.height = -1.0}), InvalidArgument);
  EXPECT_TRUE(detect_footplants(Motion(body.motion.shared_skeleton(), 30.0), legs).empty());
}

TEST(FootplantDetector, FindsAlternatingFeetInRealWalksRunsAndShuffles) {
  STRUT_REQUIRE_REAL_DATA();
  for (const char* what : {"walk_normal_001", "run_active_001", "run_elderly_003", "walk_elderly_002"}) {
    const Motion clip = read_bvh(test::real_data() + "/bandai-namco/dataset-2_" + what + ".bvh").motion;
    const auto plants = detected(clip);
    std::vector<motion::Footplant> in_time;
    for (const auto& plant : plants) {
      if (plant.begin > 0) in_time.push_back(plant);
    }
    std::sort(in_time.begin(), in_time.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    ASSERT_GE(in_time.size(), 4U) << what;
    for (std::size_t i = 1; i < in_time.size(); ++i) EXPECT_NE(in_time[i].foot, in_time[i - 1].foot) << what << i;
  }
}

}  // namespace
}  // namespace strut::postprocess
