// SPDX-License-Identifier: MIT
// Joins of motions: that they do not pop, what they leave alone, how they end, and what they refuse.
#include "support/data.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/inertialization.h>
#include <strut/generate/walker.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::effort {
namespace {

constexpr double kRounding = 1e-9;

Motion walk(double speed, double crouch = 0.0, double turn_rate = 0.0) {
  generate::WalkContent content;
  content.duration = 5.0;
  content.speed = speed;
  content.turn_rate = turn_rate;
  generate::WalkStyle style;
  style.crouch = crouch;
  style.variation = 0.0;
  return generate::generate_walk(content, style, 30.0).motion;
}

/// Joints' accelerations in the world, largest over the joints of each frame [m/s^2]; 0 at the ends.
std::vector<double> accelerations(const Motion& motion) {
  const auto places = motion::joint_positions_world(motion);
  std::vector<double> largest(places.size(), 0.0);
  for (std::size_t t = 1; t + 1 < places.size(); ++t) {
    for (std::size_t j = 0; j < places[t].size(); ++j) {
      const Eigen::Vector3d change = places[t + 1][j] - 2.0 * places[t][j] + places[t - 1][j];
      largest[t] = std::max(largest[t], change.norm() * std::pow(motion.frame_rate(), 2));
    }
  }
  return largest;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double distance(const Motion& a, int frame_a, const Motion& b, int frame_b) {
  const auto one = motion::forward_kinematics(a.skeleton(), a.frame(frame_a));
  const auto other = motion::forward_kinematics(b.skeleton(), b.frame(frame_b));
  double most = 0.0;
  for (std::size_t j = 0; j < one.positions.size(); ++j) {
    most = std::max(most, (one.positions[j] - other.positions[j]).norm());
  }
  return most;
}

/// A still body that holds its arm at an angle, or turns it.
Motion arm(double angle, double rate, int frames) {
  static const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"hips", -1, {0.0, 0.0, 0.0}}, {"arm", 0, {0.2, 0.4, 0.0}}, {"spine", 0, {0.0, 0.5, 0.0}}});
  std::vector<Pose> poses(static_cast<std::size_t>(frames), rest_pose(*skeleton));
  for (int t = 0; t < frames; ++t) {
    poses[static_cast<std::size_t>(t)].rotations[1] = math::exp_map({angle + rate * t / 30.0, 0.0, 0.0});
  }
  return {skeleton, 30.0, std::move(poses)};
}

double angle(const Motion& motion, int frame) {
  return math::log_map(motion.frame(frame).rotations[1]).x();
}

TEST(Join, OfOnePieceIsIt) {
  const Motion only = walk(1.2, 0.0, 0.4);
  const JoinedMotion joined = join(std::vector<Motion>{only});
  ASSERT_EQ(joined.motion.num_frames(), only.num_frames());
  EXPECT_EQ(joined.begins, std::vector<int>{0});
  for (int t = 0; t < only.num_frames(); ++t) EXPECT_LT(distance(joined.motion, t, only, t), kRounding);
}

TEST(Join, LeavesAloneWhatFollowsInItsSource) {
  const Motion clip = walk(1.2, 0.0, 0.4);
  const JoinedMotion joined =
      join({Piece{clip.slice(0, 20), 7, 0}, Piece{clip.slice(20, 23), 7, 20}, Piece{clip.slice(23, 90), 7, 23}});
  EXPECT_EQ(joined.begins, (std::vector<int>{0, 20, 23}));
  for (int t = 0; t < 90; ++t) EXPECT_LT(distance(joined.motion, t, clip, t), kRounding);
}

TEST(Join, HardlyChangesWhatFollowsUnknowingly) {
  const Motion clip = walk(1.2, 0.0, 0.4);
  const JoinedMotion joined = join(std::vector<Motion>{clip.slice(0, 40), clip.slice(40, 90)});
  constexpr double kMillimetre = 1e-3;  // of the one step over the ground that is not known; measured: 0.4 mm
  for (int t = 0; t < 90; ++t) EXPECT_LT(distance(joined.motion, t, clip, t), kMillimetre);
}

TEST(Join, DoesNotPop) {
  const Motion a = walk(1.3), b = walk(1.0, 0.08, 0.3);
  std::vector<double> sources = accelerations(a);
  for (const double value : accelerations(b)) sources.push_back(value);
  const double goal = 1.5 * quantile(sources, 0.99);
  // Frames of like phase, as matched content has.
  const JoinedMotion joined =
      join(std::vector<Motion>{a.slice(0, 60), motion::moved(b, {4.0, 0.0, 1.0}, 2.0).slice(60, 120)});
  const std::vector<double> after = accelerations(joined.motion);
  EXPECT_LE(*std::max_element(after.begin(), after.end()), goal);
}

TEST(Join, PopsWithoutDecay) {
  // The check above can fail: a decay of a frame leaves the leap in.
  const Motion a = walk(1.3), b = walk(1.0, 0.08, 0.3);
  const double goal = 1.5 * quantile(accelerations(a), 0.99);
  JoinOptions options;
  options.longest_decay = options.shortest_decay = 0.03;
  const std::vector<double> after =
      accelerations(join(std::vector<Motion>{a.slice(0, 60), b.slice(60, 120)}, options).motion);
  EXPECT_GT(*std::max_element(after.begin(), after.end()), goal);
}

TEST(Join, ForgetsAfterTheDecay) {
  const Motion joined = join(std::vector<Motion>{arm(0.0, 0.0, 30), arm(0.6, 0.0, 30)}).motion;
  EXPECT_NEAR(angle(joined, 17), 0.0, kRounding);  // 0.4 s and a frame before
  EXPECT_NEAR(angle(joined, 42), 0.6, kRounding);  // and after
  for (int t = 17; t < 42; ++t) EXPECT_LT(angle(joined, t), angle(joined, t + 1) + kRounding) << "overshoot at " << t;
  EXPECT_NEAR(angle(joined, 29) + angle(joined, 30), 0.6, kRounding) << "the sides share the way";
}

TEST(Join, LooksAheadOnlyIfItMay) {
  JoinOptions options;
  options.looks_ahead = false;
  const Motion joined = join(std::vector<Motion>{arm(0.0, 0.0, 30), arm(0.6, 0.0, 30)}, options).motion;
  EXPECT_NEAR(angle(joined, 29), 0.0, kRounding);
  EXPECT_LT(angle(joined, 30), 0.02);
  EXPECT_NEAR(angle(joined, 42), 0.6, kRounding);
}

TEST(Join, DoesNotOvershootWhatClosesByItself) {
  // The arm moves to where the next piece holds it, and would be there in 0.15 s.
  JoinOptions options;
  options.looks_ahead = false;
  const Motion joined = join(std::vector<Motion>{arm(0.0, 2.0, 30), arm(2.27, 0.0, 30)}, options).motion;
  for (int t = 0; t < joined.num_frames(); ++t) EXPECT_LE(angle(joined, t), 2.27 + kRounding) << t;
}

TEST(Join, GoesTheShorterWayRoundAndNeverFlips) {
  const Motion joined = join(std::vector<Motion>{arm(-1.5, 0.3, 30), arm(1.6, 0.3, 30)}).motion;
  for (int t = 1; t < joined.num_frames(); ++t) {
    const double step = joined.frame(t).rotations[1].angularDistance(joined.frame(t - 1).rotations[1]);
    constexpr double kLargestStep = 0.4;  // of 3 rad in 0.8 s: at most 1.9 times the mean
    EXPECT_LT(step, kLargestStep) << t;
  }
}

TEST(Join, GoesOnFromWhereTheLastPieceEnded) {
  const Motion a = walk(1.2), b = motion::moved(walk(1.2), {20.0, 0.0, -3.0}, 1.0);
  const Motion joined = join(std::vector<Motion>{a.slice(0, 60), b.slice(60, 120)}).motion;
  const auto end = joined.frame(119).translations[0];
  const auto straight = a.frame(119).translations[0];
  constexpr double kNear = 0.02;  // of steps continued unknowing [m]
  EXPECT_NEAR((end - straight).norm(), 0.0, kNear);
}

TEST(Join, TakesPiecesShorterThanTheDecay) {
  const Motion a = walk(1.2), b = walk(1.0, 0.05);
  std::vector<Motion> pieces{a.slice(0, 40)};
  for (int t = 40; t < 60; t += 2) pieces.push_back((t % 4 == 0 ? b : a).slice(t, t + 2));
  pieces.push_back(b.slice(60, 61));
  pieces.push_back(a.slice(61, 100));
  const JoinedMotion joined = join(pieces);
  EXPECT_EQ(joined.motion.num_frames(), 100);
  EXPECT_EQ(joined.begins.size(), pieces.size());
  const std::vector<double> after = accelerations(joined.motion);
  constexpr double kTimes = 3.0;  // a dozen joins in a third of a second; measured: 1.6
  EXPECT_LE(*std::max_element(after.begin(), after.end()), kTimes * quantile(accelerations(a), 1.0));
  EXPECT_EQ(join(std::vector<Motion>{a.slice(0, 1), b.slice(0, 1)}).motion.num_frames(), 2);
}

TEST(Join, CarriesFootplantsAlong) {
  const Motion a = walk(1.2);
  const JoinedMotion joined = join(std::vector<Motion>{a.slice(0, 30), a.slice(40, 70)});
  const auto plants = joined_plants(joined, {{{1, 5, 20}, {0, 20, 30}}, {{0, 0, 4}, {1, 10, 20}}});
  EXPECT_EQ(plants, (std::vector<motion::Footplant>{{0, 20, 34}, {1, 5, 20}, {1, 40, 50}}));
  EXPECT_THROW(joined_plants(joined, {{}}), InvalidArgument);
}

TEST(Join, RefusesWhatItCannotJoin) {
  const Motion a = walk(1.2);
  EXPECT_THROW(join(std::vector<Motion>{}), InvalidArgument);
  EXPECT_THROW(join(std::vector<Motion>{a, a.slice(0, 0)}), InvalidArgument);
  EXPECT_THROW(join(std::vector<Motion>{a, Motion(a.shared_skeleton(), 60.0, a.frames())}), InvalidArgument);
  EXPECT_THROW(join(std::vector<Motion>{a, arm(0.0, 0.0, 10)}), SkeletonMismatch);
  for (const auto& [shortest, longest] : {std::pair{0.0, 0.4}, {0.3, 0.2}, {0.2, 2.5}, {0.2, std::nan("")}}) {
    JoinOptions options;
    options.shortest_decay = shortest;
    options.longest_decay = longest;
    EXPECT_THROW(join(std::vector<Motion>{a, a}, options), InvalidArgument);
  }
}

}  // namespace
}  // namespace strut::effort
