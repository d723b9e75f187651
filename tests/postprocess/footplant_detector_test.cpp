// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/stepper.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
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

/// How far the toe is, at the first frame of `found`, from where it stands in the middle of `truth` [m].
double away_at_landing(const generate::Walk& walk, const motion::Legs& legs, const motion::Footplant& found,
                       const motion::Footplant& truth) {
  const auto toe = [&](int frame) {
    const auto world = motion::forward_kinematics(walk.motion.skeleton(), walk.motion.frame(frame));
    return motion::toe_position(legs.foot(truth.foot), world);
  };
  return (toe(found.begin) - toe((truth.begin + truth.end) / 2)).norm();
}

// A rolling foot comes to rest slowly: its last centimetres take a tenth of a second, and no threshold sees their end.
constexpr double kHeld = 0.035;       // [m]
constexpr double kLate = 1.0 / 30.0;  // a landing is never seen later than this [s]

void expect_true_plants(const char* what, const generate::WalkContent& content, const generate::WalkStyle& style) {
  for (const double rate : {30.0, 60.0}) {
    const generate::Walk walk = generate::generate_walk(content, style, rate);
    const auto legs = *motion::find_legs(walk.motion);
    const auto found = detect_footplants(walk.motion, legs);
    for (const auto& truth : walk.footplants) {
      if (truth.begin == 0 || truth.end - truth.begin < 0.15 * rate) continue;
      const auto same = std::find_if(found.begin(), found.end(), [&](const motion::Footplant& plant) {
        return plant.foot == truth.foot && plant.begin < truth.end && plant.end > truth.begin;
      });
      ASSERT_NE(same, found.end()) << what << " at frame " << truth.begin;
      EXPECT_LE(same->begin, truth.begin + kLate * rate) << what;
      EXPECT_LT(away_at_landing(walk, legs, *same, truth), kHeld) << what << ", " << rate << " frames/s";
      EXPECT_NEAR(same->end, truth.end, 3.0 / 60.0 * rate + 1.0) << what;
    }
  }
}

TEST(FootplantDetector, FindsWhereGeneratedFeetAreHeld) {
  generate::WalkContent turn;
  turn.turn_rate = 1.0;
  generate::WalkContent slow;
  slow.speed = 0.5;
  expect_true_plants("plain", {}, {});
  expect_true_plants("limp", {}, {.limp = 1.0});
  expect_true_plants("march", {}, {.foot_lift = 0.25});
  expect_true_plants("flat", {}, {.heel_strike = 0.0, .push_off = 0.2});
  expect_true_plants("turn", turn, {});
  expect_true_plants("shuffle", slow,
                     {.step_length_scale = 0.6, .foot_lift = 0.01, .heel_strike = 0.0, .push_off = 0.2});
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
