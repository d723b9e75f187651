// SPDX-License-Identifier: MIT
#include "metrics/test_body.h"
#include "support/data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/metrics/clip_distance.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/resample.h>

namespace strut::metrics {
namespace {

using test::test_motion;

constexpr double kSinglePrecision = 2e-6;  // [m]: a few roundings of metres, thirty of them summed

/// Hands that wave `cycles` times a second, `reach` metres up and down.
Motion waving(int frames, double cycles, double reach) {
  return test_motion(frames, 30.0, [=](Pose& pose, double t) {
    pose.translations[test::kHandL].y() += reach * std::sin(2.0 * std::numbers::pi * cycles * t);
    pose.translations[test::kHandR].y() += reach * std::cos(2.0 * std::numbers::pi * cycles * t);
  });
}

/// A clip of random poses of the upper body.
Motion random_motion(int frames) {
  return test_motion(frames, 30.0, [](Pose& pose, double) {
    for (const int joint : {test::kChest, test::kHead, test::kHandL, test::kHandR}) {
      const Eigen::Vector3d shift(*rc::gen::inRange(-100, 101), *rc::gen::inRange(-100, 101), 0.0);
      pose.translations[static_cast<std::size_t>(joint)] += shift / 500.0;
    }
  });
}

double frame_distance(const BodyTrack& a, int i, const BodyTrack& b, int j) {
  double sum = 0.0;
  for (int k = 0; k < a.num_joints(); ++k) {
    sum += (a.positions_heading.block<1, 3>(i, 3 * k) - b.positions_heading.block<1, 3>(j, 3 * k)).norm();
  }
  return sum / a.num_joints();
}

/// Least cost of the rest of the window after frame i has been laid on frame j: every path is walked.
double cheapest_rest(const BodyTrack& a, int i, int end, const BodyTrack& b, int j) {
  if (i + 1 == end) return 0.0;
  double best = std::numeric_limits<double>::infinity();
  const auto at = [&](int row, int column) { return frame_distance(a, row, b, column); };
  if (j + 1 < b.num_frames()) best = at(i + 1, j + 1) + cheapest_rest(a, i + 1, end, b, j + 1);
  if (j + 2 < b.num_frames()) {
    best = std::min(best, 0.5 * (at(i + 1, j + 1) + at(i + 1, j + 2)) + cheapest_rest(a, i + 1, end, b, j + 2));
  }
  if (i + 2 < end && j + 1 < b.num_frames()) {
    best = std::min(best, at(i + 1, j + 1) + at(i + 2, j + 1) + cheapest_rest(a, i + 2, end, b, j + 1));
  }
  return best;
}

double one_way_by_force(const BodyTrack& a, const BodyTrack& b) {
  const int length = std::min(a.num_frames(), std::max(1, 3 * b.num_frames() / 2));
  double sum = 0.0;
  int windows = 0;
  for (int start = 0; start + length <= a.num_frames(); start += std::max(1, length / 2), ++windows) {
    double best = std::numeric_limits<double>::infinity();
    for (int j = 0; j < b.num_frames(); ++j) {
      best = std::min(best, frame_distance(a, start, b, j) + cheapest_rest(a, start, start + length, b, j));
    }
    sum += best / length;
  }
  return sum / windows;
}

RC_GTEST_PROP(ClipDistance, IsTheBestOfAllPathsOnShortClips, ()) {
  const BodyTrack a = body_track(random_motion(*rc::gen::inRange(1, 8)), 30.0);
  const BodyTrack b = body_track(random_motion(*rc::gen::inRange(1, 8)), 30.0);
  const ClipDistance found = clip_distance(a, b);
  RC_ASSERT(std::abs(found.first_in_second - one_way_by_force(a, b)) < kSinglePrecision);
  RC_ASSERT(std::abs(found.second_in_first - one_way_by_force(b, a)) < kSinglePrecision);
}

RC_GTEST_PROP(ClipDistance, IsSymmetric, ()) {
  const Motion a = random_motion(*rc::gen::inRange(1, 50));
  const Motion b = random_motion(*rc::gen::inRange(1, 50));
  RC_ASSERT(std::abs(clip_distance(a, b).distance - clip_distance(b, a).distance) < kSinglePrecision);
}

TEST(ClipDistance, IsZeroForAClipMovedAndTurned) {
  const Motion clip = waving(100, 0.7, 0.2);
  EXPECT_LT(clip_distance(clip, motion::moved(clip, {2.0, 0.0, 1.0}, 2.0)).distance, kSinglePrecision);
}

TEST(ClipDistance, OfAHeadHeldHigherIsItsShareOfTheBody) {
  const Motion low = test_motion(45, 30.0);
  const Motion high = test_motion(70, 30.0, [](Pose& pose, double) { pose.translations[test::kHead].y() += 0.26; });
  const ClipDistance found = clip_distance(low, high);
  EXPECT_NEAR(found.distance, 0.26 / test::kNumJoints, kSinglePrecision);
  EXPECT_EQ(found.worst.begin.joint, test::kHead);
  EXPECT_NEAR(found.worst.joint_distance, 0.26, kSinglePrecision);
}

TEST(ClipDistance, ForgivesASlowerPaceUpToHalf) {
  const Motion clip = waving(120, 0.5, 0.3);
  const double at_the_same_pace = clip_distance(clip, waving(120, 0.5, 0.1)).distance;
  EXPECT_LT(clip_distance(clip, waving(150, 0.3, 0.3)).distance, 0.1 * at_the_same_pace);
  EXPECT_GT(clip_distance(clip, waving(150, 0.1, 0.3)).distance, 0.5 * at_the_same_pace);
}

TEST(ClipDistance, NamesTheWorstSecondAndItsJoint) {
  const Motion still = test_motion(150, 30.0);
  const Motion raised = test_motion(150, 30.0, [](Pose& pose, double t) {
    if (t >= 2.0 && t < 3.0) pose.translations[test::kHandR].y() += 0.4;
  });
  const WorstMatch worst = clip_distance(still, raised).worst;
  EXPECT_FALSE(worst.in_first);
  EXPECT_EQ(worst.begin.frame, 60);
  EXPECT_NEAR(worst.begin.time, 2.0, 1e-9);
  EXPECT_EQ(worst.begin.joint, test::kHandR);
  EXPECT_NEAR(worst.joint_distance, 0.4, kSinglePrecision);
}

TEST(ClipDistance, ComparesClipsOfDifferentRates) {
  const auto wave = [](Pose& pose, double t) { pose.translations[test::kHandL].y() += 0.2 * std::sin(4.0 * t); };
  const Motion fast = test_motion(400, 120.0, wave);
  EXPECT_LT(clip_distance(test_motion(100, 30.0, wave), fast).distance, kSinglePrecision);
  EXPECT_THROW(clip_distance(body_track(fast, 30.0), body_track(fast, 60.0)), InvalidArgument);
}

TEST(ClipDistance, RefusesAnotherSkeletonByName) {
  std::vector<Joint> joints = test::test_skeleton()->joints();
  joints[test::kHead].name = "skull";
  const auto other = std::make_shared<const Skeleton>(joints);
  try {
    clip_distance(test_motion(40, 30.0), Motion(other, 30.0, {rest_pose(*other)}));
    FAIL() << "accepted";
  } catch (const SkeletonMismatch& error) {
    EXPECT_STREQ(error.what(), "the clips have different skeletons: missing 'head'; unknown 'skull'");
  }
}

// Computed once by an independent implementation (Python, SciPy, double precision) of the definition in the header.
struct Reference {
  const char* first;
  const char* second;
  double distance_cm;
};

constexpr double kOfReference = 1e-5;  // relative: frame times are printed to six digits, positions to five

TEST(ClipDistance, AgreesWithAnIndependentImplementationOnRealClips) {
  STRUT_REQUIRE_REAL_DATA();
  const std::string folder = strut::test::real_data() + "/bandai-namco/dataset-2_";
  for (const Reference& reference : {
           Reference{"walk_normal_013", "walk_elderly_013", 4.6720829},
           Reference{"walk_active_005", "walk_active_014", 2.9755942},
           Reference{"run_normal_015", "run_active_014", 4.9275217},
           Reference{"walk-turn-left_normal_016", "walk-turn-left_feminine_016", 3.6191724},
           Reference{"wave-left-hand_normal_014", "wave-left-hand_active_013", 5.4320667},
           Reference{"raise-up-right-hand_elderly_009", "raise-up-right-hand_elderly_017", 2.3733535},
           Reference{"walk_feminine_013", "wave-both-hands_normal_013", 12.9187192},
       }) {
    const Motion first = read_bvh(folder + reference.first + ".bvh").motion;
    const Motion second = read_bvh(folder + reference.second + ".bvh").motion;
    EXPECT_NEAR(100.0 * clip_distance(first, second).distance, reference.distance_cm,
                kOfReference * reference.distance_cm)
        << reference.first << " and " << reference.second;
  }
}

}  // namespace
}  // namespace strut::metrics
