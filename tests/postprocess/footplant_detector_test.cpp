// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/stepper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
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

// Frames are a thirtieth of a second in most of these clips, and the stepping body's feet start slowly [s].
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
  const int landing = body.footplants.back().begin;  // of the right foot, while the left one stands
  std::vector<Pose> frames(60, body.motion.frame(landing));
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

struct GeneratedWalk {
  const char* name;
  generate::WalkContent content;
  generate::WalkStyle style;
};

generate::WalkContent walk_at(const generate::Schedule& speed, double turn_rate = 0.0, double travel_direction = 0.0) {
  generate::WalkContent content;
  content.speed = speed;
  content.turn_rate = turn_rate;
  content.travel_direction = travel_direction;
  return content;
}

std::vector<GeneratedWalk> generated_walks() {
  constexpr double kRightAngle = std::numbers::pi / 2.0;
  const generate::Schedule halt({{0.0, 1.3}, {2.0, 1.3}, {2.5, 0.0}, {4.0, 0.0}, {4.5, 1.3}});
  const generate::Schedule start({{0.0, 0.0}, {1.5, 0.0}, {2.0, 1.3}});
  return {{"plain", {}, {}},
          {"limp", {}, {.limp = 1.0}},
          {"march", {}, {.foot_lift = 0.25}},
          {"crouch", {}, {.crouch = 0.2}},
          {"wide", {}, {.step_width = 0.35}},
          {"flat", {}, {.heel_strike = 0.0, .push_off = 0.2}},
          {"quick", {}, {.cadence_scale = 1.5}},
          {"child", {}, {.body_height = 1.2}},
          {"slow", walk_at(0.5), {}},
          {"fast", walk_at(2.0), {}},
          {"turning", walk_at(1.3, 1.0), {.limp = 0.5}},
          {"sideways", walk_at(0.6, 0.0, kRightAngle), {}},
          {"backwards", walk_at(0.7, 0.0, 2.0 * kRightAngle), {}},
          {"shuffle", walk_at(0.5), {.step_length_scale = 0.6, .foot_lift = 0.01, .heel_strike = 0.0, .push_off = 0.2}},
          {"halt", walk_at(halt), {}},
          {"start", walk_at(start), {}},
          {"standing", walk_at(0.0), {}}};
}

std::vector<bool> marked(const std::vector<motion::Footplant>& plants, int num_frames) {
  std::vector<bool> marks(2 * static_cast<std::size_t>(num_frames));
  for (const auto& plant : plants) {
    for (int t = plant.begin; t < plant.end; ++t) marks[static_cast<std::size_t>(plant.foot * num_frames + t)] = true;
  }
  return marks;
}

/// Share of both feet's frames on which two lists agree.
double agreement(const std::vector<motion::Footplant>& a, const std::vector<motion::Footplant>& b, int num_frames) {
  const auto in_a = marked(a, num_frames), in_b = marked(b, num_frames);
  int right = 0;
  for (std::size_t i = 0; i < in_a.size(); ++i) right += in_a[i] == in_b[i] ? 1 : 0;
  return static_cast<double>(right) / static_cast<double>(in_a.size());
}

/// What the clip's end cuts so short cannot be told from a foot that turns round [s].
constexpr double kTooShortToSee = 0.1;

/// Every plant of `truth` once in `found`, its begin and end within `frames`, and no other.
void expect_plants(const std::string& what, const std::vector<motion::Footplant>& found,
                   const std::vector<motion::Footplant>& truth, const Motion& clip, int frames) {
  std::size_t seen = 0;
  for (const auto& plant : truth) {
    const auto same = std::find_if(found.begin(), found.end(), [&](const motion::Footplant& other) {
      return other.foot == plant.foot && other.begin < plant.end && other.end > plant.begin;
    });
    if (same == found.end()) {
      EXPECT_TRUE(plant.begin == 0 || plant.end == clip.num_frames()) << what << " at frame " << plant.begin;
      EXPECT_LT(plant.end - plant.begin, kTooShortToSee * clip.frame_rate()) << what << " at frame " << plant.begin;
      continue;
    }
    ++seen;
    EXPECT_NEAR(same->begin, plant.begin, frames) << what;
    EXPECT_NEAR(same->end, plant.end, frames) << what;
  }
  EXPECT_EQ(seen, found.size()) << what;
}

// The goal: frames right, over walks, and frames from the true landing and leaving, in every plant.
constexpr double kShareRight = 0.98;
constexpr int kFramesOff = 2;
// In one walk at 30 frames/s a frame is 3 % of a cycle and the truth lies between two of them.
constexpr double kShareRightInOne = 0.97;

TEST(FootplantDetector, FindsWhereGeneratedFeetAreHeld) {
  for (const double rate : {30.0, 60.0, 120.0}) {
    double sum = 0.0;
    int count = 0;
    for (GeneratedWalk walk : generated_walks()) {
      for (const std::uint64_t seed : {1U, 2U}) {
        walk.style.seed = seed;
        const std::string what = std::string(walk.name) + " at " + std::to_string(rate);
        const generate::Walk made = generate::generate_walk(walk.content, walk.style, rate);
        const auto found = detected(made.motion);
        expect_plants(what, found, made.footplants, made.motion, kFramesOff);
        const double right = agreement(found, made.footplants, made.motion.num_frames());
        EXPECT_GE(right, kShareRightInOne) << what;
        sum += right;
        ++count;
      }
    }
    EXPECT_GE(sum / count, kShareRight) << rate;
  }
}

// A foot that slides is not held anywhere: where its slide becomes a step is known to a tenth of a second or so.
constexpr double kShareRightOfSliding = 0.90;

TEST(FootplantDetector, FindsThePlantsOfFeetThatSlide) {
  for (const double speed : {0.1, 0.25, 0.4}) {
    const generate::Walk walk = generate::generate_walk({}, {}, 30.0);
    std::vector<Pose> frames = walk.motion.frames();
    for (std::size_t t = 0; t < frames.size(); ++t) {
      const double time = static_cast<double>(t) / 30.0;
      frames[t].translations[0] += speed * Eigen::Vector3d(0.2 * std::sin(2.0 * time), 0.0, time);
    }
    const Motion sliding(walk.motion.shared_skeleton(), 30.0, frames);
    const auto found = detected(sliding);
    EXPECT_EQ(found.size(), walk.footplants.size()) << speed;
    EXPECT_GE(agreement(found, walk.footplants, sliding.num_frames()), kShareRightOfSliding) << speed;
  }
}

TEST(FootplantDetector, SeesThroughNoise) {
  const generate::Walk walk = generate::generate_walk({}, {}, 120.0);
  std::vector<Pose> frames = walk.motion.frames();
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.0004);  // what optical capture leaves on a marker [m]
  for (Pose& frame : frames) frame.translations[0] += Eigen::Vector3d(noise(random), noise(random), noise(random));
  const Motion noisy(walk.motion.shared_skeleton(), 120.0, frames);
  // The noise alone is 0.1 m/s from one frame to the next: the last half centimetre of a landing drowns in it.
  EXPECT_GE(agreement(detected(noisy), walk.footplants, noisy.num_frames()), 0.9);
}

TEST(FootplantDetector, DoesNotTakeALiftedFootForAStandingOne) {
  const auto body = test::stepping_body({});
  std::vector<Pose> frames(60, body.motion.frame(0));
  const auto legs = *motion::find_legs(body.motion);
  const auto world = motion::forward_kinematics(body.motion.skeleton(), frames[0]);
  const bool left_is_lower = motion::toe_position(legs.left, world).y() < motion::toe_position(legs.right, world).y();
  const motion::Leg& lifted = left_is_lower ? legs.right : legs.left;
  for (Pose& frame : frames) frame.translations[static_cast<std::size_t>(lifted.ankle)].y() += 0.3;
  const std::vector<motion::Footplant> standing = {{left_is_lower ? 0 : 1, 0, 60}};
  EXPECT_EQ(detect_footplants(Motion(body.motion.shared_skeleton(), 30.0, frames), legs), standing);
}

TEST(FootplantDetector, RefusesThresholdsThatCross) {
  const auto body = test::stepping_body({});
  const auto legs = *motion::find_legs(body.motion);
  EXPECT_THROW(detect_footplants(body.motion, legs, {.landing_speed = 0.3, .leaving_speed = 0.2}), InvalidArgument);
  EXPECT_THROW(detect_footplants(body.motion, legs, {.height = -1.0}), InvalidArgument);
  EXPECT_THROW(detect_footplants(body.motion, legs, {.held_speed = 0.1, .released_speed = 0.05}), InvalidArgument);
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
