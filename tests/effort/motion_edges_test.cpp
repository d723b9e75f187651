// SPDX-License-Identifier: MIT
// How motions begin and end, what goes together, and that the cheapest sequence is the cheapest.
#include "effort/motion_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <strut/generate/walker.h>
#include <strut/motion/legs.h>

namespace strut::effort {
namespace {

constexpr double kRounding = 1e-9;

Motion walk() {
  generate::WalkContent content;
  content.duration = 2.0;
  return generate::generate_walk(content, {}, 30.0).motion;
}

MotionEdge still_at(double place) {
  return {Eigen::VectorXd::Constant(1, place), Eigen::VectorXd::Zero(1), 0.0};
}

TEST(MotionEdges, OfAMotionThatGoesOnFitBestThere) {
  const Motion motion = walk();
  const auto upright = motion::upright_reference({motion});
  const FeatureSpace space = fit_feature_space({joint_features(motion, upright)});
  const PostureSpace in{upright, space, 0.3};
  const MotionEdge end = ending(motion.slice(0, 20), in);
  const auto edges = edges_within(motion, 10, 31, in);
  const double there = misfit(end, edges[10], motion.frame_time(), in.unit);  // frame 20
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i >= 8 && i <= 10) continue;  // velocities are of steps two frames apart: a frame or two earlier may fit better
    EXPECT_GT(misfit(end, edges[i], motion.frame_time(), in.unit), there) << 10 + i;
  }
  EXPECT_EQ(edges_within(motion.slice(3, 4), 0, 1, in).front().velocity.norm(), 0.0) << "a single frame";
}

TEST(MotionEdges, KnowHowFastJointsAccelerate) {
  const Motion motion = walk();
  const std::vector<double> all = joint_accelerations(motion);
  EXPECT_EQ(std::ssize(all), (motion.num_frames() - 2) * motion.skeleton().num_joints());
  EXPECT_EQ(largest_acceleration(motion, 0, motion.num_frames()), *std::max_element(all.begin(), all.end()));
  EXPECT_EQ(largest_acceleration(motion, 0, 1), 0.0) << "no inner frame";
}

TEST(Misfit, IsThatOfPostureAndVelocity) {
  MotionEdge moving = still_at(0.0);
  moving.velocity[0] = 3.0;
  EXPECT_NEAR(misfit(still_at(0.0), still_at(0.4), 0.1, 0.2), 4.0, kRounding);
  EXPECT_NEAR(misfit(moving, {Eigen::VectorXd::Constant(1, 0.3), moving.velocity, 0.0}, 0.1, 1.0), 0.0, kRounding);
}

TEST(CheapestSequence, IsTheBestOfAll) {
  std::vector<std::vector<SequenceCandidate>> places(4);
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const double at = std::sin(static_cast<double>(5 * k) + 2.0 * c);
      places[k].push_back({0.1 * c, still_at(at), still_at(std::cos(3.0 * at + c))});
    }
  }
  const auto price = [&](const std::vector<std::size_t>& way) {
    double sum = 0.0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      sum += places[k][way[k]].price;
      if (k > 0) sum += 0.7 * misfit(places[k - 1][way[k - 1]].end, places[k][way[k]].begin, 0.1, 0.5);
    }
    return sum;
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 81; ++i) least = std::min(least, price({i / 27, i / 9 % 3, i / 3 % 3, i % 3}));
  EXPECT_NEAR(price(cheapest_sequence(places, 0.7, 0.1, 0.5)), least, kRounding);
  EXPECT_TRUE(cheapest_sequence({}, 1.0, 0.1, 1.0).empty());
}

}  // namespace
}  // namespace strut::effort
