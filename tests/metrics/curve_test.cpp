// SPDX-License-Identifier: MIT
// Curves, and that they are what the figures are the means of.
#include "metrics/test_body.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/metrics/curve.h>
#include <strut/metrics/foot_slide.h>
#include <strut/metrics/gait.h>
#include <strut/metrics/smoothness.h>

namespace strut::metrics {
namespace {

using test::test_motion;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-10;
constexpr double kJerkRounding = 1e-7;  // third differences of metres, times 27000

BodyTrack track_of(const Motion& motion) {
  return body_track(motion, measuring_rate(motion.frame_rate()));
}

Motion generated_walk() {
  return generate::generate_walk(generate::WalkContent{}, generate::WalkStyle{}, 60.0).motion;
}

/// Mean of the numbers there are in all of `curves`.
double mean_of(const std::vector<Curve>& curves) {
  double sum = 0.0;
  int count = 0;
  for (const Curve& curve : curves) {
    for (const double value : curve.values) {
      if (std::isnan(value)) continue;
      sum += value;
      ++count;
    }
  }
  return sum / count;
}

TEST(CurveAtFrames, LiesBetweenItsValues) {
  const Eigen::VectorXd values = at_frames({30.0, 0.0, Eigen::Vector3d(0.0, 4.0, 2.0)}, 9, 120.0);
  const std::vector<double> expected{0, 1, 2, 3, 4, 3.5, 3, 2.5, 2};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(values[static_cast<Eigen::Index>(i)], expected[i], kRounding) << i;
  }
}

TEST(CurveAtFrames, ReachesHalfAStepBeyondALonelyValueAndNoFarther) {
  Eigen::VectorXd values(5);
  values << kNone, kNone, 7.0, kNone, kNone;
  const Eigen::VectorXd frames = at_frames({30.0, 0.5 / 30.0, values}, 6, 30.0);  // values between the frames
  for (const int i : {0, 1, 4, 5}) EXPECT_TRUE(std::isnan(frames[i])) << i;
  EXPECT_EQ(frames[2], 7.0);
  EXPECT_EQ(frames[3], 7.0);
}

TEST(CurveAtFrames, RefusesRatesThatAreNone) {
  EXPECT_THROW(at_frames({0.0, 0.0, {}}, 3, 30.0), InvalidArgument);
  EXPECT_THROW(at_frames({30.0, 0.0, {}}, 3, kNone), InvalidArgument);
  EXPECT_THROW(at_frames({30.0, 0.0, {}}, -1, 30.0), InvalidArgument);
}

TEST(JerkCurve, HasTheFigureAsItsMean) {
  const Motion walk = generated_walk();
  EXPECT_NEAR(jerk_curve(track_of(walk)).values.mean(), smoothness(walk).jerk, kJerkRounding);
}

TEST(JerkCurve, OfAllJointsIsTheMeanOfTheJoints) {
  const BodyTrack track = track_of(generated_walk());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(track.num_frames() - 3);
  for (const int joint : track.joints) sum += jerk_curve(track, joint).values;
  EXPECT_LT((sum / track.num_joints() - jerk_curve(track).values).cwiseAbs().maxCoeff(), kJerkRounding);
}

TEST(JerkCurve, ShowsWhereAMovementJerks) {
  const auto jolt = [](Pose& pose, double t) {
    if (t > 1.0) pose.translations[test::kHandL].z() += 2.0 * std::pow(t - 1.0, 3);
  };
  const Motion motion = test_motion(61, 30.0, jolt);
  const Eigen::VectorXd jerk = at_frames(jerk_curve(track_of(motion), test::kHandL), 61, 30.0);
  EXPECT_TRUE(std::isnan(jerk[0]));
  EXPECT_NEAR(jerk[20], 0.0, kJerkRounding);
  EXPECT_NEAR(jerk[45], 12.0 / 3.0, kJerkRounding);  // along one axis of three
}

TEST(JerkCurve, RefusesWhatTheTrackDoesNotHold) {
  EXPECT_THROW(jerk_curve(track_of(test_motion(3, 30.0))), InvalidArgument);
  EXPECT_THROW(jerk_curve(track_of(test_motion(9, 30.0)), test::kNumJoints), InvalidArgument);
}

TEST(JointSpeedCurve, IsRelativeToTheBody) {
  const auto wave = [](Pose& pose, double t) {
    pose.translations[0].z() += 3.0 * t;
    pose.translations[test::kHandL].y() += 0.6 * t;
  };
  const BodyTrack track = track_of(test_motion(30, 30.0, wave));
  EXPECT_NEAR(joint_speed_curve(track, test::kHandL).values.maxCoeff(), 0.6, kRounding);
  EXPECT_NEAR(joint_speed_curve(track, test::kHead).values.maxCoeff(), 0.0, kRounding);
  EXPECT_THROW(joint_speed_curve(track, -1), InvalidArgument);
}

TEST(FootSlideCurve, HasTheFigureAsItsMean) {
  const auto slip = [](Pose& pose, double t) { pose.translations[test::kAnkleL].x() += 0.1 * t * t; };
  const BodyTrack track = track_of(test_motion(241, 120.0, slip));
  const std::vector<motion::Footplant> plants{{0, 10, 101}, {0, 130, 241}, {1, 0, 241}};
  const double mean = mean_of({foot_slide_curve(track, plants, 0), foot_slide_curve(track, plants, 1)});
  EXPECT_GT(mean, 0.05);
  EXPECT_NEAR(mean, foot_slide(track, plants).speed, kRounding);
}

TEST(FootSlideCurve, HasNumbersWhereTheFootStandsOnly) {
  const auto glide = [](Pose& pose, double t) { pose.translations[0].x() += 0.5 * t; };
  const BodyTrack track = track_of(test_motion(61, 30.0, glide));
  const Eigen::VectorXd slide = at_frames(foot_slide_curve(track, {{0, 10, 21}, {1, 0, 61}}, 0), 61, 30.0);
  for (int i = 0; i < 61; ++i) EXPECT_EQ(std::isnan(slide[i]), i < 10 || i > 20) << i;
  EXPECT_NEAR(slide[10], 0.5, kRounding);
  EXPECT_NEAR(slide[20], 0.5, kRounding);
}

TEST(FootSlideCurve, RefusesAThirdFootAndPlantsOutsideTheClip) {
  const BodyTrack track = track_of(test_motion(30, 30.0));
  EXPECT_THROW(foot_slide_curve(track, {}, 2), InvalidArgument);
  EXPECT_THROW(foot_slide_curve(track, {{0, 0, 40}}, 1), InvalidArgument);
}

TEST(FootHeightCurve, IsOfTheLowerEnd) {
  const auto lift = [](Pose& pose, double t) { pose.translations[test::kKneeR].y() += 0.3 * t; };
  const BodyTrack track = track_of(test_motion(31, 30.0, lift));
  EXPECT_NEAR(foot_height_curve(track, 1).values[30] - foot_height_curve(track, 1).values[0], 0.3, kRounding);
  EXPECT_NEAR(foot_height_curve(track, 0).values[30], 1.0 - 0.05 - 0.45 - 0.42 - 0.06, kRounding);
  EXPECT_THROW(foot_height_curve(track, -1), InvalidArgument);
}

TEST(GroundSpeedCurve, OfAGlidingBodyIsItsSpeed) {
  const auto glide = [](Pose& pose, double t) { pose.translations[0] += Eigen::Vector3d(0.3 * t, t, 0.4 * t); };
  const Curve curve = ground_speed_curve(track_of(test_motion(90, 30.0, glide)));
  EXPECT_NEAR(curve.values.minCoeff(), 0.5, kRounding);
  EXPECT_NEAR(curve.values.maxCoeff(), 0.5, kRounding);
  EXPECT_THROW(ground_speed_curve(track_of(test_motion(1, 30.0))), InvalidArgument);
}

TEST(TurnRateCurve, OfACarouselIsItsRateBeyondAFullTurn) {
  const auto turn = [](Pose& pose, double t) {
    pose.rotations[0] = Eigen::AngleAxisd(4.0 * t, Eigen::Vector3d::UnitY());
  };
  const Curve curve = turn_rate_curve(track_of(test_motion(90, 30.0, turn)));
  EXPECT_NEAR(curve.values.minCoeff(), 4.0, kRounding);
  EXPECT_NEAR(curve.values.maxCoeff(), 4.0, kRounding);
}

}  // namespace
}  // namespace strut::metrics
