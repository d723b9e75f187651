// SPDX-License-Identifier: MIT
// The facts a generated gesture promises, over the eight actions.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/gestures.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::generate {
namespace {

constexpr double kIntegration = 1e-7;    // of content time in steps of different length, times the joints' speed
constexpr double kStanding = 1e-9;       // of a planted foot [m]: rounding of inverse kinematics
constexpr double kBetweenFrames = 2e-3;  // of a pose read between frames of 1/240 s [m]
constexpr double kFastestJoint = 30.0;   // [rad/s]; measured: 27, an elbow; people's reach that
constexpr double kSharpestJoint =
    1100.0;  // [rad/s^2]; measured: 905, the most sudden throw; a pop of 5 degrees in a frame has 1250

class GestureCase : public testing::TestWithParam<int> {
 protected:
  GestureContent content = gesture_content(static_cast<GestureAction>(GetParam()));
};

INSTANTIATE_TEST_SUITE_P(Actions, GestureCase, testing::Range(0, kNumGestureActions), [](const auto& given) {
  return gesture_content(static_cast<GestureAction>(given.param)).name;
});

std::vector<GestureStyle> corners() {
  std::vector<GestureStyle> all(1);
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) all.push_back({.suddenness = a, .boundness = b, .strength = c, .extent = 1.2});
    }
  }
  return all;
}

TEST_P(GestureCase, IsTheSameAtAnotherRate) {
  const GestureStyle style{.suddenness = 0.5, .boundness = 0.7};
  const Gesture slow = generate_gesture(content, style, performer(2), 30.0);
  const Gesture fast = generate_gesture(content, style, performer(2), 120.0);
  const auto a = motion::joint_positions_world(slow.motion), b = motion::joint_positions_world(fast.motion);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(slow.content_time[i], fast.content_time[4 * i], kIntegration);
    for (std::size_t j = 0; j < a[i].size(); ++j) EXPECT_LT((a[i][j] - b[4 * i][j]).norm(), kIntegration);
  }
}

TEST_P(GestureCase, PlantedFeetDoNotMove) {
  const int first_of_leg[] = {15, 19};  // the ankle; the toe follows
  for (const GestureStyle& style : corners()) {
    const Gesture gesture = generate_gesture(content, style, performer(1), 60.0);
    const auto positions = motion::joint_positions_world(gesture.motion);
    ASSERT_GE(gesture.footplants.size(), 2U);
    for (const motion::Footplant& plant : gesture.footplants) {
      const auto ankle = static_cast<std::size_t>(first_of_leg[plant.foot]);
      const auto begin = static_cast<std::size_t>(plant.begin), end = static_cast<std::size_t>(plant.end);
      for (std::size_t i = begin; i < end; ++i) {
        EXPECT_LT((positions[i][ankle] - positions[begin][ankle]).norm(), kStanding);
        EXPECT_LT((positions[i][ankle + 1] - positions[begin][ankle + 1]).norm(), kStanding);
      }
    }
  }
}

TEST_P(GestureCase, JointsTurnSmoothly) {
  for (const GestureStyle& style : corners()) {
    const Motion motion = generate_gesture(content, style, performer(0), 120.0).motion;
    for (int j = 0; j < motion.skeleton().num_joints(); ++j) {
      const auto joint = static_cast<std::size_t>(j);
      Eigen::Vector3d before = Eigen::Vector3d::Zero();
      for (int i = 1; i < motion.num_frames(); ++i) {
        const Eigen::Vector3d turn =
            120.0 * math::log_map(motion.frame(i - 1).rotations[joint].conjugate() * motion.frame(i).rotations[joint]);
        EXPECT_LT(turn.norm(), kFastestJoint) << motion.skeleton().joint(j).name;
        if (i == 1) before = turn;
        EXPECT_LT(120.0 * (turn - before).norm(), kSharpestJoint) << motion.skeleton().joint(j).name;
        before = turn;
      }
    }
  }
}

TEST_P(GestureCase, CorrespondsWhereItsContentIsTheSame) {
  GestureStyle style{.suddenness = -0.8, .boundness = -1.0, .variation = 0.0};
  const Gesture a = generate_gesture(content, style, {}, 240.0);
  style.suddenness = 0.8;
  const Gesture b = generate_gesture(content, style, {}, 240.0);
  EXPECT_GT(a.motion.num_frames(), b.motion.num_frames());
  const auto in_a = motion::joint_positions_world(a.motion), in_b = motion::joint_positions_world(b.motion);
  const std::vector<double> frames = true_correspondence(a, b);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto before = static_cast<std::size_t>(std::min(frames[i], static_cast<double>(in_b.size()) - 2.0));
    const double weight = frames[i] - static_cast<double>(before);
    for (std::size_t j = 0; j < in_a[i].size(); ++j) {
      const Eigen::Vector3d between = (1.0 - weight) * in_b[before][j] + weight * in_b[before + 1][j];
      EXPECT_LT((in_a[i][j] - between).norm(), kBetweenFrames);
    }
  }
}

double lowest_hips(const Gesture& gesture) {
  double lowest = 10.0;
  for (const Pose& pose : gesture.motion.frames()) lowest = std::min(lowest, pose.translations[0].y());
  return lowest;
}

TEST_P(GestureCase, StrongIsLowerAndSuddenIsShorter) {
  const auto with = [&](const GestureStyle& style) { return generate_gesture(content, style); };
  EXPECT_LT(lowest_hips(with({.strength = 0.8})), lowest_hips(with({.strength = -0.8})) - 0.03);
  EXPECT_LT(with({.suddenness = 0.8}).motion.duration(), 0.8 * with({.suddenness = -0.8}).motion.duration());
}

TEST(Gesture, StaysOnTheGroundAtAnyHeight) {
  for (const double height : {1.3, 2.0}) {
    const Gesture gesture = generate_gesture(gesture_content(GestureAction::kLunge), {}, {.height = height});
    for (const auto& joints : motion::joint_positions_world(gesture.motion)) {
      for (const Eigen::Vector3d& joint : joints) EXPECT_GT(joint.y(), 0.0);
    }
  }
}

TEST(Gesture, SaysWhatItCannotDo) {
  const GestureContent bow = gesture_content(GestureAction::kBow);
  EXPECT_THROW(generate_gesture({}), InvalidArgument);
  EXPECT_THROW(generate_gesture(bow, {.suddenness = 1.5}), InvalidArgument);
  EXPECT_THROW(generate_gesture(bow, {.boundness = NAN}), InvalidArgument);
  EXPECT_THROW(generate_gesture(bow, {}, {.height = 0.5}), InvalidArgument);
  EXPECT_THROW(generate_gesture(bow, {}, {}, 0.0), InvalidArgument);
  EXPECT_THROW(true_correspondence(generate_gesture(bow), generate_gesture(gesture_content(GestureAction::kReach))),
               InvalidArgument);
}

TEST(StandardGestures, HoldEverySettingOnce) {
  const std::vector<StandardGesture> all = standard_gestures(3);
  ASSERT_EQ(all.size(), 240U);
  for (std::size_t first = 0; first < all.size(); first += 6) {
    int sixths = 0;
    for (std::size_t k = first; k < first + 6; ++k) {
      EXPECT_EQ(all[k].action, all[first].action);
      EXPECT_EQ(all[k].performer, all[first].performer);
      sixths |= 1 << static_cast<int>((all[k].style.boundness + 1.0) * 3.0);
    }
    EXPECT_EQ(sixths, 63);
  }
}

TEST(StandardGestures, LastOneToFourSeconds) {
  for (const StandardGesture& each : standard_gestures()) {
    EXPECT_GT(each.gesture.motion.duration(), 0.8);
    EXPECT_LT(each.gesture.motion.duration(), 4.0);
    EXPECT_TRUE(std::is_sorted(each.gesture.content_time.begin(), each.gesture.content_time.end()));
  }
}

TEST(StandardGestures, RepeatWithTheirSeed) {
  const auto a = standard_gestures(5), b = standard_gestures(5), c = standard_gestures(6);
  EXPECT_TRUE(a[17].gesture.motion.frames() == b[17].gesture.motion.frames());
  EXPECT_FALSE(a[17].gesture.motion.frames() == c[17].gesture.motion.frames());
}

}  // namespace
}  // namespace strut::generate
