// SPDX-License-Identifier: MIT
#include "metrics/test_body.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/metrics/gait.h>
#include <strut/motion/kinematics.h>

namespace strut::metrics {
namespace {

using test::test_motion;

constexpr double kRounding = 1e-10;

/// Legs that swing against each other `cycles` times a second under a body that walks at `speed`.
Motion striding(double seconds, double rate, double cycles, double speed) {
  return test_motion(static_cast<int>(seconds * rate), rate, [=](Pose& pose, double t) {
    const double swing = 0.3 * std::sin(2.0 * std::numbers::pi * cycles * t);
    pose.translations[0].z() += speed * t;
    pose.translations[test::kAnkleL].z() += swing;
    pose.translations[test::kAnkleR].z() -= swing;
  });
}

TEST(Gait, CountsTwoStepsACycle) {
  // Ten cycles have twenty changes of lead, of which the first has no leader before it.
  EXPECT_NEAR(gait(body_track(striding(10.0, 30.0, 1.0, 1.2), 30.0)).cadence, 1.9, kRounding);
  EXPECT_NEAR(gait(body_track(striding(10.0, 120.0, 1.0, 1.2), 30.0)).cadence, 1.9, kRounding);
}

TEST(Gait, SpeedIsTheWayOverTheTime) {
  const Gait found = gait(body_track(striding(10.0, 30.0, 1.0, 1.2), 30.0));
  EXPECT_NEAR(found.speed, 1.2 * 299.0 / 300.0, kRounding);
  EXPECT_NEAR(found.travel, 1.2 * 299.0 / 30.0, kRounding);
  EXPECT_NEAR(found.top_speed, 1.2, kRounding);
}

TEST(Gait, IsTheSameWhicheverWayOneWalks) {
  const Motion clip = striding(6.0, 30.0, 0.9, 1.0);
  const Gait straight = gait(body_track(clip, 30.0));
  const Gait turned = gait(body_track(motion::moved(clip, {4.0, 0.0, 1.0}, 2.5), 30.0));
  EXPECT_DOUBLE_EQ(straight.cadence, turned.cadence);
  EXPECT_NEAR(straight.speed, turned.speed, kRounding);
}

TEST(Gait, OfABodyThatStaysPutIsNothing) {
  const Gait found = gait(body_track(striding(5.0, 30.0, 1.0, 0.0), 30.0));
  EXPECT_EQ(found.cadence, 0.0);
  EXPECT_EQ(found.speed, 0.0);
}

TEST(Gait, FindsTheLongestStep) {
  const Motion pause = test_motion(240, 30.0, [](Pose& pose, double t) {
    // Steps every half second, but the foot that comes to lead at 3 s keeps the lead until 4.5 s.
    const double phase = t < 3.25 ? t : t < 4.25 ? 3.25 : t - 1.0;
    const double swing = 0.3 * std::sin(2.0 * std::numbers::pi * phase);
    pose.translations[0].z() += t;
    pose.translations[test::kAnkleL].z() += swing;
    pose.translations[test::kAnkleR].z() -= swing;
  });
  const Gait found = gait(body_track(pause, 30.0));
  EXPECT_NEAR(found.longest_step, 1.5, 2.0 / 30.0);
  EXPECT_EQ(found.longest_step_begin.joint, test::kAnkleL);
  EXPECT_NEAR(found.longest_step_begin.time, 3.05, 2.0 / 30.0);
}

TEST(Gait, FindsTheFastestMoment) {
  const Motion sprint = test_motion(
      150, 30.0, [](Pose& pose, double t) { pose.translations[0].z() += t + 2.0 * std::clamp(t - 2.0, 0.0, 0.5); });
  const Gait found = gait(body_track(sprint, 30.0));
  EXPECT_NEAR(found.top_speed, 3.0, kRounding);
  EXPECT_NEAR(found.fastest.time, 2.25, 0.25);
}

}  // namespace
}  // namespace strut::metrics
