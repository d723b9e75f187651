// SPDX-License-Identifier: MIT
#include "metrics/test_body.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/metrics/foot_slide.h>

namespace strut::metrics {
namespace {

using test::test_motion;

constexpr double kRounding = 1e-10;

BodyTrack track_of(const Motion& motion) {
  return body_track(motion, measuring_rate(motion.frame_rate()));
}

TEST(FootSlide, IsZeroForFeetThatStand) {
  EXPECT_NEAR(foot_slide(track_of(test_motion(90, 30.0))).speed, 0.0, kRounding);
}

TEST(FootSlide, OfAGlidingBodyIsItsSpeed) {
  const auto glide = [](Pose& pose, double t) { pose.translations[0] += Eigen::Vector3d(0.3 * t, 0, 0.4 * t); };
  EXPECT_NEAR(foot_slide(track_of(test_motion(90, 30.0, glide))).speed, 0.5, kRounding);
  EXPECT_NEAR(foot_slide(track_of(test_motion(360, 120.0, glide))).speed, 0.5, kRounding);
}

TEST(FootSlide, IgnoresFeetThatMoveUpAndDown) {
  const auto hop = [](Pose& pose, double t) { pose.translations[0].y() += 0.3 * t * t; };
  EXPECT_NEAR(foot_slide(track_of(test_motion(60, 30.0, hop))).speed, 0.0, kRounding);
}

TEST(FootSlide, CountsOnlyTheSlowestPartOfEachSecond) {
  // 0.5 s at 1 m/s, 0.5 s at rest, again and again: the feet do stand once a second.
  const auto lurch = [](Pose& pose, double t) {
    const double whole = std::floor(t + 1e-9);
    pose.translations[0].z() += 0.5 * whole + std::min(t - whole, 0.5);
  };
  EXPECT_NEAR(foot_slide(track_of(test_motion(120, 30.0, lurch))).speed, 0.0, kRounding);
}

TEST(FootSlide, NamesTheFootAndSecondThatSlideMost) {
  const auto slip = [](Pose& pose, double t) {
    pose.translations[test::kToeR].x() += 0.2 * std::clamp(t - 0.9, 0.0, 1.3);
  };
  const FootSlide slide = foot_slide(track_of(test_motion(120, 30.0, slip)));
  EXPECT_NEAR(slide.speed, 0.0, kRounding);  // the median: one second of six
  EXPECT_NEAR(slide.worst_speed, 0.2, kRounding);
  EXPECT_EQ(slide.worst.joint, test::kToeR);
  EXPECT_GE(slide.worst.frame, 30);
  EXPECT_LE(slide.worst.frame, 69);
}

TEST(FootSlide, MeasuresAClipShorterThanAFootplant) {
  const auto glide = [](Pose& pose, double t) { pose.translations[0].z() += 0.5 * t; };
  EXPECT_NEAR(foot_slide(track_of(test_motion(2, 30.0, glide))).speed, 0.5, kRounding);
  EXPECT_THROW(foot_slide(track_of(test_motion(1, 30.0, glide))), InvalidArgument);
}

TEST(FootSlideOfPlants, IsTheMeanOverPlantedFrames) {
  const auto slip = [](Pose& pose, double t) { pose.translations[test::kAnkleL].x() += 0.1 * std::max(0.0, t - 1.0); };
  const BodyTrack track = track_of(test_motion(61, 30.0, slip));
  const FootSlide slide = foot_slide(track, {{0, 0, 31}, {0, 30, 61}, {1, 0, 61}});
  EXPECT_NEAR(slide.speed, 0.1 / 4.0, kRounding);  // ten centimetres over one, one and two seconds
  EXPECT_NEAR(slide.worst_speed, 0.1, kRounding);
  EXPECT_EQ(slide.worst.joint, test::kToeL);
  EXPECT_EQ(slide.worst.frame, 45);
}

TEST(FootSlideOfPlants, TakesFramesOfTheGivenClip) {
  const auto slip = [](Pose& pose, double t) { pose.translations[test::kAnkleL].x() += 0.1 * t; };
  const FootSlide slide = foot_slide(track_of(test_motion(241, 120.0, slip)), {{0, 120, 241}});
  EXPECT_NEAR(slide.speed, 0.1, kRounding);
  EXPECT_EQ(slide.worst.frame, 180);
}

TEST(FootSlideOfPlants, IgnoresAFootThatRollsOverItsToe) {
  const Motion roll = test_motion(31, 30.0, [](Pose& pose, double t) {
    pose.translations[test::kAnkleL].z() += 0.1 * t;
    pose.translations[test::kToeL].z() -= 0.1 * t;
  });
  EXPECT_NEAR(foot_slide(track_of(roll), {{0, 0, 31}}).speed, 0.0, kRounding);
}

TEST(FootSlideOfPlants, OfAGeneratedWalkIsZeroInItsTrueFootplants) {
  const generate::Walk walk = generate::generate_walk(generate::WalkContent{}, generate::WalkStyle{}, 60.0);
  const FootSlide slide = foot_slide(body_track(walk.motion, 60.0), walk.footplants);
  EXPECT_GE(slide.worst.joint, 0);
  EXPECT_LT(slide.worst_speed, kRounding);
}

TEST(FootSlideOfPlants, WithoutAPlantIsNothing) {
  const FootSlide slide = foot_slide(track_of(test_motion(30, 30.0)), {});
  EXPECT_EQ(slide.speed, 0.0);
  EXPECT_EQ(slide.worst.joint, -1);
}

TEST(FootSlideOfPlants, RefusesPlantsOutsideTheClip) {
  const BodyTrack track = track_of(test_motion(30, 30.0));
  EXPECT_THROW(foot_slide(track, {{2, 0, 10}}), InvalidArgument);
  EXPECT_THROW(foot_slide(track, {{0, -1, 10}}), InvalidArgument);
  EXPECT_THROW(foot_slide(track, {{0, 0, 40}}), InvalidArgument);
}

}  // namespace
}  // namespace strut::metrics
