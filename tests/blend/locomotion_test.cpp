// SPDX-License-Identifier: MIT
// Walks that are made: no seams, the speed asked for, feet that stand, cycles that loop.
#include "small_gaits.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/blend/locomotion.h>
#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>

namespace strut::blend {
namespace {

using test::small_gaits;
using testing::HasSubstr;

constexpr double kSpeedOff = 0.03;  // share by which speed may be off
constexpr double kSlide = 0.01;     // of planted feet [m/s]
constexpr double kClosed = 1e-3;    // of a looping cycle [rad], [m], per second

GaitControls controls(double plain, double crouch, double march, double speed, double turn_rate = 0.0) {
  return {Eigen::Vector3d(plain, crouch, march), speed, turn_rate};
}

Eigen::Vector3d ground(const Motion& motion, int f) {
  Eigen::Vector3d place = motion.frame(f).translations[0];
  place.y() = 0.0;
  return place;
}

/// Mean speed of toes over planted frames [m/s].
double slide(const SynthesizedGait& gait) {
  const auto legs = motion::find_legs(gait.motion).value();
  double sum = 0.0;
  int count = 0;
  for (const motion::Footplant& plant : gait.footplants) {
    for (int f = plant.begin; f + 1 < plant.end; ++f) {
      const auto toe = [&](int k) {
        return motion::toe_position(legs.foot(plant.foot),
                                    motion::forward_kinematics(gait.motion.skeleton(), gait.motion.frame(k)));
      };
      sum += (toe(f + 1) - toe(f)).norm() * gait.motion.frame_rate();
      ++count;
    }
  }
  return sum / count;
}

TEST(Synthesis, KeepsTheSpeedAskedForAndItsFeetStand) {
  for (const auto& asked : {controls(1, 0, 0, 1.1), controls(0, 0.5, 0.5, 0.9), controls(0.3, 0.3, 0.4, 1.3)}) {
    const SynthesizedGait gait = synthesize(small_gaits().model, {{0.0, asked}}, 15.0);
    const int last = gait.motion.num_frames() - 1;
    const double speed =
        (ground(gait.motion, last) - ground(gait.motion, 0)).norm() / (last * gait.motion.frame_time());
    EXPECT_NEAR(speed / asked.speed, 1.0, kSpeedOff);
    EXPECT_LT(slide(gait), kSlide);
    EXPECT_GE(gait.footplants.size(), 20U);
  }
}

TEST(Synthesis, HasNoSeamWhereStyleAndSpeedChange) {
  const auto steady = [&](const GaitControls& c) { return synthesize(small_gaits().model, {{0.0, c}}, 6.0); };
  const auto roughest = [](const Motion& motion) {
    double most = 0.0;
    for (int f = 1; f + 1 < motion.num_frames(); ++f) {
      for (std::size_t j = 0; j < motion.frame(0).rotations.size(); ++j) {
        const auto step = [&](int k) {
          return math::log_map(motion.frame(k).rotations[j].conjugate() * motion.frame(k + 1).rotations[j]);
        };
        most = std::max(most, (step(f) - step(f - 1)).norm());
      }
    }
    return most;
  };
  const auto crouch = controls(0, 1, 0, 0.7), march = controls(0, 0, 1, 1.3);
  const double usual = std::max(roughest(steady(crouch).motion), roughest(steady(march).motion));
  const auto changing =
      synthesize(small_gaits().model, {{0.0, crouch}, {3.0, crouch}, {4.0, march}, {6.0, march}, {7.0, crouch}}, 10.0);
  EXPECT_LT(roughest(changing.motion), 1.5 * usual);
}

TEST(Synthesis, TurnsAsAsked) {
  const auto gait = synthesize(small_gaits().model, {{0.0, controls(1, 0, 0, 1.0, 0.4)}}, 5.0);
  const auto legs = motion::find_legs(gait.motion).value();
  double turned = 0.0, before = 0.0;
  for (int f = 0; f < gait.motion.num_frames(); ++f) {
    const double facing =
        motion::facing(legs, motion::forward_kinematics(gait.motion.skeleton(), gait.motion.frame(f)));
    if (f > 0) turned += math::wrap_angle(facing - before);
    before = facing;
  }
  EXPECT_NEAR(turned, 0.4 * 5.0, 0.25) << "the pelvis also twists with the steps";
}

TEST(Synthesis, CyclesLoop) {
  const SynthesizedGait cycle = synthesize_cycle(small_gaits().model, controls(0.5, 0.5, 0, 0.9));
  const int count = cycle.motion.num_frames();
  // What a frame's velocity differs by from its neighbours', over the seam (the last) as elsewhere.
  const auto roughness = [&](int f) {
    double most = 0.0;
    for (std::size_t j = 0; j < cycle.motion.frame(0).rotations.size(); ++j) {
      const auto step = [&](int k) {
        return math::log_map(cycle.motion.frame((k + count) % count).rotations[j].conjugate() *
                             cycle.motion.frame((k + 1 + count) % count).rotations[j]);
      };
      most = std::max(most, (2.0 * step(f) - step(f - 1) - step(f + 1)).norm());
    }
    return most;
  };
  double elsewhere = 0.0;
  for (int f = 0; f + 1 < count; ++f) elsewhere = std::max(elsewhere, roughness(f));
  EXPECT_LE(roughness(count - 1), elsewhere);
  EXPECT_NEAR(count / 60.0, small_gaits().model->loop(Eigen::Vector3d(0.5, 0.5, 0), 0.9).duration(), 0.5 / 60.0 + 1e-9);
}

TEST(Synthesis, LoopsCloseForEveryMixture) {
  for (const double crouch : {-0.3, 0.0, 0.5, 1.0}) {
    const GaitLoop loop = small_gaits().model->loop(Eigen::Vector3d(1.0 - crouch, crouch, 0.0), 1.0);
    EXPECT_LT((loop.at(1.0) - loop.at(0.0)).cwiseAbs().maxCoeff(), kClosed);
    EXPECT_LT((loop.rate_at(1.0) * loop.pace(1.0) - loop.rate_at(0.0) * loop.pace(0.0)).cwiseAbs().maxCoeff(), kClosed);
  }
}

TEST(Synthesis, TellsHowFarItLeavesTheExamples) {
  Diagnostics told;
  synthesize(small_gaits().model, {{0.0, controls(1, 0, 0, 1.8)}}, 2.0, {}, &told);
  ASSERT_EQ(told.entries().size(), 1U);
  EXPECT_THAT(told.entries()[0].message, HasSubstr("faster than the examples"));
  Diagnostics weights;
  synthesize(small_gaits().model, {{0.0, controls(1.5, 0, -0.5, 1.0)}}, 2.0, {}, &weights);
  EXPECT_EQ(weights.entries().size(), 2U);
  Diagnostics inside;
  synthesize(small_gaits().model, {{0.0, controls(1, 0, 0, 1.0)}}, 2.0, {}, &inside);
  EXPECT_TRUE(inside.entries().empty());
}

TEST(Synthesis, RefusesWhatItCannotMake) {
  const auto& model = small_gaits().model;
  const auto plain = controls(1, 0, 0, 1.0);
  EXPECT_THROW(synthesize(nullptr, {{0.0, plain}}, 1.0), InvalidArgument);
  EXPECT_THROW(synthesize(model, {}, 1.0), InvalidArgument);
  EXPECT_THROW(synthesize(model, {{1.0, plain}, {1.0, plain}}, 1.0), InvalidArgument);
  EXPECT_THROW(synthesize(model, {{std::nan(""), plain}}, 1.0), InvalidArgument);
  EXPECT_THROW(synthesize(model, {{0.0, plain}}, 0.0), InvalidArgument);
  EXPECT_THROW(synthesize(model, {{0.0, plain}}, std::nan("")), InvalidArgument);
  EXPECT_THROW(synthesize(model, {{0.0, controls(1, 0, 0, 1.0, 3.0)}}, 1.0), InvalidArgument);
  EXPECT_THROW(synthesize(model, {{0.0, controls(1, 0, 0, -1.0)}}, 1.0), InvalidArgument);
  EXPECT_THROW(synthesize(model, {{0.0, plain}}, 1.0, {.frame_rate = 2.0}), InvalidArgument);
  EXPECT_THROW(Walker(model, 0.0), InvalidArgument);
}

}  // namespace
}  // namespace strut::blend
