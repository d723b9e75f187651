// SPDX-License-Identifier: MIT
// The facts a generated walk promises, over a set of walks that covers its parameters.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::generate {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRounding = 1e-9;         // metres, radians: sums of a hundred roundings stay far below
constexpr double kPenetration = 1e-4;      // of a foot's sole into the ground [m]; measured: 1e-5 as toes leave it
constexpr double kFastestJoint = 16.0;     // [rad/s]; measured: 12 at 2 m/s, as people's ankles reach
constexpr double kSharpestJoint = 900.0;   // [rad/s^2]; measured: 680 at 2 m/s; a pop of 5 degrees in a frame has 1250
constexpr double kStraightestKnee = 0.25;  // [rad]: 14 degrees, so that a knee never snaps
constexpr double kSharpestKnee = 2.2;      // [rad]

struct Case {
  friend void PrintTo(const Case& given, std::ostream* out) { *out << given.name; }

  std::string name;
  WalkContent content;
  WalkStyle style;
};

WalkContent stop_and_go() {
  WalkContent content;
  content.duration = 8.0;
  content.speed = Schedule({{0.0, 1.3}, {2.5, 1.3}, {3.3, 0.0}, {5.3, 0.0}, {6.0, 1.3}});
  content.turn_rate = Schedule({{0.5, 0.0}, {1.0, 0.7}, {2.0, 0.7}, {2.5, 0.0}});
  return content;
}

std::vector<Case> cases() {
  const WalkContent plain{.duration = 4.0};
  std::vector<Case> all = {
      {"Plain", plain, {}},
      {"StopAndGo", stop_and_go(), {}},
      {"Limp", stop_and_go(), {.cadence_scale = 0.85, .step_length_scale = 0.8, .limp = 1.0}},
      {"LimpRight", plain, {.limp = 0.7, .limp_foot = kRight}},
      {"Crouch", plain, {.crouch = 0.25, .torso_lean = 0.4}},
      {"Fast", {.duration = 4.0, .speed = 2.0}, {}},
      {"Slow", {.duration = 4.0, .speed = 0.3}, {}},
      {"TurnLeft", {.duration = 4.0, .speed = 1.2, .turn_rate = 0.9}, {}},
      {"Sideways", {.duration = 4.0, .speed = 0.5, .travel_direction = std::numbers::pi / 2}, {}},
      {"Backwards", {.duration = 4.0, .speed = 0.7, .travel_direction = std::numbers::pi}, {}},
      {"OnTheSpot", {.duration = 4.0, .speed = 0.0, .turn_rate = 1.0}, {}},
      {"Standing", {.duration = 2.0, .speed = 0.0}, {}},
      {"March", plain, {.arm_swing = 0.8, .foot_lift = 0.2}},
      {"Child", {.duration = 4.0, .speed = 0.8}, {.body_height = 1.1}},
  };
  return all;
}

class WalkerCase : public testing::TestWithParam<Case> {
 protected:
  WalkerCase() : walk(generate_walk(GetParam().content, GetParam().style, 120.0)) {}
  Walk walk;
};

INSTANTIATE_TEST_SUITE_P(Walks, WalkerCase, testing::ValuesIn(cases()),
                         [](const auto& given) { return given.param.name; });

double largest_move(const std::vector<std::vector<Vector3d>>& positions, const motion::Footplant& plant, int joint) {
  const auto j = static_cast<std::size_t>(joint);
  double largest = 0.0;
  for (int i = plant.begin; i < plant.end; ++i) {
    const Vector3d& first = positions[static_cast<std::size_t>(plant.begin)][j];
    largest = std::max(largest, (positions[static_cast<std::size_t>(i)][j] - first).norm());
  }
  return largest;
}

int foot_joint(const Skeleton& skeleton, int foot, const char* name) {
  return skeleton.find((foot == kLeft ? "Left" : "Right") + std::string(name));
}

TEST_P(WalkerCase, PlantedFeetDoNotMove) {
  const auto positions = motion::joint_positions_world(walk.motion);
  ASSERT_FALSE(walk.footplants.empty());
  for (const auto& plant : walk.footplants) {
    EXPECT_LT(largest_move(positions, plant, foot_joint(walk.motion.skeleton(), plant.foot, "Toe")), kRounding);
  }
  for (const auto& plant : walk.flat_footplants) {
    EXPECT_LT(largest_move(positions, plant, foot_joint(walk.motion.skeleton(), plant.foot, "Toe")), kRounding);
    EXPECT_LT(largest_move(positions, plant, foot_joint(walk.motion.skeleton(), plant.foot, "Foot")), kRounding);
  }
}

TEST_P(WalkerCase, FeetMoveWheneverTheyAreNotPlanted) {
  const auto positions = motion::joint_positions_world(walk.motion);
  for (std::size_t k = 0; k + 1 < walk.footplants.size(); ++k) {
    const auto &a = walk.footplants[k], &b = walk.footplants[k + 1];
    if (a.foot != b.foot) continue;
    EXPECT_GT(b.begin - a.end, 10);  // a swing of at least a tenth of a second
    const auto middle = static_cast<std::size_t>((a.end + b.begin) / 2);
    const auto toe = static_cast<std::size_t>(foot_joint(walk.motion.skeleton(), a.foot, "Toe"));
    EXPECT_GT(positions[middle][toe].y(), positions[static_cast<std::size_t>(a.begin)][toe].y() + 0.005);
  }
}

TEST_P(WalkerCase, FootplantsOfAFootAreInOrderAndApart) {
  for (const auto* plants : {&walk.footplants, &walk.flat_footplants}) {
    for (std::size_t k = 0; k < plants->size(); ++k) {
      EXPECT_LT((*plants)[k].begin, (*plants)[k].end);
      EXPECT_GE((*plants)[k].begin, 0);
      EXPECT_LE((*plants)[k].end, walk.motion.num_frames());
      if (k > 0 && (*plants)[k].foot == (*plants)[k - 1].foot) {
        EXPECT_GT((*plants)[k].begin, (*plants)[k - 1].end);
      }
    }
  }
}

TEST_P(WalkerCase, NothingSinksIntoTheGround) {
  const Skeleton& skeleton = walk.motion.skeleton();
  for (const Pose& pose : walk.motion.frames()) {
    const auto world = motion::forward_kinematics(skeleton, pose);
    for (int j = 0; j < skeleton.num_joints(); ++j) {
      const auto index = static_cast<std::size_t>(j);
      EXPECT_GT(world.positions[index].y(), -kPenetration);
      const Vector3d tip = world.positions[index] + world.rotations[index] * skeleton.joint(j).end_site;
      EXPECT_GT(tip.y(), -kPenetration) << skeleton.joint(j).name;
    }
  }
}

TEST_P(WalkerCase, GaitPhaseNeverFallsAndContentTimeRises) {
  EXPECT_EQ(walk.content_time.size(), static_cast<std::size_t>(walk.motion.num_frames()));
  for (std::size_t i = 1; i < walk.gait_phase.size(); ++i) {
    EXPECT_GE(walk.gait_phase[i], walk.gait_phase[i - 1]);
    EXPECT_GT(walk.content_time[i], walk.content_time[i - 1]);
  }
  EXPECT_NEAR(walk.content_time.front(), 0.0, kRounding);
}

TEST_P(WalkerCase, BonesKeepTheirLengths) {
  for (const Pose& pose : walk.motion.frames()) {
    for (int j = 1; j < walk.motion.skeleton().num_joints(); ++j) {
      EXPECT_EQ(pose.translations[static_cast<std::size_t>(j)], walk.motion.skeleton().joint(j).offset);
    }
  }
}

TEST_P(WalkerCase, KneesAreHingesThatNeitherSnapNorBendBackwards) {
  for (const Pose& pose : walk.motion.frames()) {
    for (const char* name : {"LeftLeg", "RightLeg"}) {
      const auto knee = static_cast<std::size_t>(walk.motion.skeleton().find(name));
      const Vector3d angles = math::log_map(pose.rotations[knee]);
      EXPECT_GT(angles.x(), kStraightestKnee);
      EXPECT_LT(angles.x(), kSharpestKnee);
      EXPECT_LT(std::hypot(angles.y(), angles.z()), kRounding);
    }
  }
}

TEST_P(WalkerCase, JointsTurnWithoutPopping) {
  const double rate = walk.motion.frame_rate();
  for (int j = 0; j < walk.motion.skeleton().num_joints(); ++j) {
    const auto index = static_cast<std::size_t>(j);
    Vector3d before = Vector3d::Zero();
    for (int i = 1; i < walk.motion.num_frames(); ++i) {
      const Quaterniond& a = walk.motion.frame(i - 1).rotations[index];
      const Vector3d velocity = rate * math::log_map(a.conjugate() * walk.motion.frame(i).rotations[index]);
      EXPECT_LT(velocity.norm(), kFastestJoint) << walk.motion.skeleton().joint(j).name << " at frame " << i;
      if (i > 1) {
        EXPECT_LT(rate * (velocity - before).norm(), kSharpestJoint)
            << walk.motion.skeleton().joint(j).name << " at frame " << i;
      }
      before = velocity;
    }
  }
}

TEST_P(WalkerCase, IsTheSameWalkAtAnyFrameRate) {
  const Walk slow = generate_walk(GetParam().content, GetParam().style, 30.0);
  for (int i = 0; i < slow.motion.num_frames(); ++i) {
    const Pose &a = slow.motion.frame(i), &b = walk.motion.frame(4 * i);
    for (std::size_t j = 0; j < a.rotations.size(); ++j) {
      EXPECT_LT(a.rotations[j].angularDistance(b.rotations[j]), kRounding);
      EXPECT_LT((a.translations[j] - b.translations[j]).norm(), kRounding);
    }
  }
}

TEST(Walker, AchievesSpeedAndTurning) {
  constexpr double kTolerance = 1e-3;  // relative; without variation only the path's integration is left
  for (const double speed : {0.6, 1.3, 1.8}) {
    const WalkContent content{.duration = 10.0, .speed = speed, .turn_rate = 0.4};
    const WalkStyle style{.cadence_scale = 0.9, .step_length_scale = 0.8, .variation = 0.0};
    const Walk walk = generate_walk(content, style, 100.0);
    double length = 0.0;
    for (std::size_t i = 1; i < walk.path.size(); ++i) {
      length += (walk.path[i].position - walk.path[i - 1].position).norm();
    }
    const double time = (walk.motion.num_frames() - 1) / 100.0;
    EXPECT_NEAR(length / time, speed * 0.9 * 0.8, kTolerance * speed);
    EXPECT_NEAR((walk.path.back().heading - walk.path.front().heading) / walk.content_time.back(), 0.4, kTolerance);
  }
}

TEST(Walker, VariationKeepsSpeedAndTurningNearWhatIsAsked) {
  constexpr double kTolerance = 0.02;  // relative: 2 % from step to step, over forty steps
  const WalkContent content{.duration = 20.0, .speed = 1.3};
  const Walk walk = generate_walk(content, {}, 60.0);
  const double length = (walk.path.back().position - walk.path.front().position).norm();
  EXPECT_NEAR(length / ((walk.motion.num_frames() - 1) / 60.0), 1.3, kTolerance * 1.3);
}

TEST(Walker, PelvisFollowsThePath) {
  const Walk walk = generate_walk({.duration = 6.0, .turn_rate = 0.5}, {}, 60.0);
  for (int i = 0; i < walk.motion.num_frames(); ++i) {
    const PathPoint& point = walk.path[static_cast<std::size_t>(i)];
    Vector3d apart = walk.motion.frame(i).translations[0] - point.position;
    apart.y() = 0.0;
    EXPECT_LT(apart.norm(), 0.08);
    EXPECT_LT(std::abs(math::wrap_angle(math::heading(walk.motion.frame(i).rotations[0]) - point.heading)), 0.2);
  }
}

TEST(Walker, LeftAndRightAreMirrorImages) {
  constexpr double kTolerance = 1e-6;  // footholds are found by bisection
  WalkContent content{.duration = 5.0, .turn_rate = 0.6, .travel_direction = 0.2};
  WalkStyle style{.limp = 0.5, .variation = 0.0};
  const Walk walk = generate_walk(content, style, 60.0);
  content.turn_rate = -0.6;
  content.travel_direction = -0.2;
  content.first_foot = kRight;
  style.limp_foot = kRight;
  const Walk mirror = generate_walk(content, style, 60.0);
  const auto a = motion::joint_positions_world(walk.motion), b = motion::joint_positions_world(mirror.motion);
  ASSERT_EQ(a.size(), b.size());
  for (int j = 0; j < walk.motion.skeleton().num_joints(); ++j) {
    std::string name = walk.motion.skeleton().joint(j).name;
    if (name.rfind("Left", 0) == 0)
      name = "Right" + name.substr(4);
    else if (name.rfind("Right", 0) == 0)
      name = "Left" + name.substr(5);
    const auto other = static_cast<std::size_t>(walk.motion.skeleton().find(name));
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vector3d mirrored = b[i][other].cwiseProduct(Vector3d(-1, 1, 1));
      EXPECT_LT((a[i][static_cast<std::size_t>(j)] - mirrored).norm(), kTolerance);
    }
  }
}

TEST(Walker, AHealthyWalkIsSymmetricAndALimpIsNotInTimeAndSpace) {
  const auto step_of = [](double limp, int foot) {  // mean duration and length of the steps that end on `foot`
    const Walk walk = generate_walk({.duration = 12.0}, {.limp = limp, .variation = 0.0}, 240.0);
    const double shift = foot == kLeft ? 0.0 : 0.5;
    const auto frame_at = [&](double phase) {
      return std::lower_bound(walk.gait_phase.begin(), walk.gait_phase.end(), phase) - walk.gait_phase.begin();
    };
    const auto positions = motion::joint_positions_world(walk.motion);
    const auto own = static_cast<std::size_t>(foot_joint(walk.motion.skeleton(), foot, "Foot"));
    const auto others = static_cast<std::size_t>(foot_joint(walk.motion.skeleton(), 1 - foot, "Foot"));
    const auto lands = static_cast<std::size_t>(frame_at(5.0 + shift));
    const auto flat = static_cast<std::size_t>(frame_at(5.25 + shift));
    const auto other_flat = static_cast<std::size_t>(frame_at(4.75 + shift));
    const double seconds = static_cast<double>(lands - static_cast<std::size_t>(frame_at(4.5 + shift))) / 240.0;
    return std::pair(seconds, positions[flat][own].z() - positions[other_flat][others].z());
  };
  const auto [left_time, left_length] = step_of(0.0, kLeft);
  const auto [right_time, right_length] = step_of(0.0, kRight);
  EXPECT_NEAR(left_time, right_time, 0.01);
  EXPECT_NEAR(left_length, right_length, 0.005);
  const auto [bad_time, bad_length] = step_of(0.8, kLeft);
  const auto [good_time, good_length] = step_of(0.8, kRight);
  EXPECT_GT(bad_time, 1.3 * good_time);  // the good leg hurries while the bad one carries
  EXPECT_GT(bad_length, 1.25 * good_length);
}

TEST(Walker, ALimpThrowsTheTrunkOverTheBadLeg) {
  const Walk walk = generate_walk({.duration = 6.0}, {.limp = 1.0, .limp_foot = kRight, .variation = 0.0}, 60.0);
  const auto positions = motion::joint_positions_world(walk.motion);
  const auto head = static_cast<std::size_t>(walk.motion.skeleton().find("Head"));
  double left = 0.0, right = 0.0;
  for (const auto& frame : positions) {
    left = std::max(left, frame[head].x());
    right = std::max(right, -frame[head].x());
  }
  EXPECT_GT(right, left + 0.05);
}

TEST(Walker, StandsStillInAPauseWithBothFeetDown) {
  const Walk walk = generate_walk(stop_and_go(), {}, 60.0);
  int begin = 0, end = 0;
  for (int i = 1; i < walk.motion.num_frames(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (walk.gait_phase[index] != walk.gait_phase[index - 1]) continue;
    if (end == 0) begin = i - 1;
    end = i + 1;
  }
  ASSERT_GT(end - begin, 60);  // of the two seconds asked for, the step that closes the feet takes some
  const auto positions = motion::joint_positions_world(walk.motion);
  for (int i = begin; i < end; ++i) {
    for (std::size_t j = 0; j < positions.front().size(); ++j) {
      const Vector3d& first = positions[static_cast<std::size_t>(begin)][j];
      // The gaze already turns to where the walk will go.
      EXPECT_LT((positions[static_cast<std::size_t>(i)][j] - first).norm(), j == 4 ? 0.02 : kRounding);
    }
  }
  for (const int foot : {kLeft, kRight}) {
    EXPECT_TRUE(std::any_of(walk.flat_footplants.begin(), walk.flat_footplants.end(), [&](const auto& plant) {
      return plant.foot == foot && plant.begin <= begin && plant.end >= end;
    }));
  }
}

TEST(Walker, TheSameSeedGivesTheSameWalkAndAnotherSeedAnother) {
  const Walk a = generate_walk({}, {.seed = 3}), b = generate_walk({}, {.seed = 3}), c = generate_walk({}, {.seed = 4});
  EXPECT_EQ(a.motion.frames(), b.motion.frames());
  EXPECT_EQ(a.footplants, b.footplants);
  EXPECT_NE(a.motion.frame(30), c.motion.frame(30));
}

TEST(Walker, ACorrespondenceJoinsFramesOfEqualPhase) {
  const Walk normal = generate_walk(stop_and_go(), {}, 120.0);
  const Walk limp = generate_walk(stop_and_go(), {.cadence_scale = 0.8, .limp = 0.8, .seed = 9}, 120.0);
  EXPECT_GT(limp.motion.duration(), 1.1 * normal.motion.duration());
  const std::vector<double> frames = true_correspondence(normal, limp);
  ASSERT_EQ(frames.size(), normal.gait_phase.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto before = static_cast<std::size_t>(frames[i]);
    const auto after = std::min(before + 1, limp.gait_phase.size() - 1);
    const double weight = frames[i] - static_cast<double>(before);
    const double phase = (1.0 - weight) * limp.gait_phase[before] + weight * limp.gait_phase[after];
    EXPECT_NEAR(phase, normal.gait_phase[i], 1e-3);  // linear between frames 1/120 s apart
    if (i > 0) {
      EXPECT_GE(frames[i], frames[i - 1]);
    }
  }
}

TEST(Walker, AWalkCorrespondsToItself) {
  const Walk walk = generate_walk({}, {.limp = 0.5});
  const std::vector<double> frames = true_correspondence(walk, walk);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_NEAR(frames[i], static_cast<double>(i), 1e-6);
}

TEST(Walker, RefusesNumbersOutsideTheirRanges) {
  EXPECT_THROW(generate_walk({.duration = 0.0}, {}), InvalidArgument);
  EXPECT_THROW(generate_walk({.speed = -1.0}, {}), InvalidArgument);
  EXPECT_THROW(generate_walk({}, {.cadence_scale = 0.0}), InvalidArgument);
  EXPECT_THROW(generate_walk({}, {.torso_lean = std::nan("")}), InvalidArgument);
  EXPECT_THROW(generate_walk({}, {}, 0.0), InvalidArgument);
  EXPECT_THROW(walker_skeleton(17.5), InvalidArgument);
  EXPECT_THROW(generate_walk({.speed = 2.5}, {.step_length_scale = 1.59}), InvalidArgument);
  EXPECT_THROW(true_correspondence(generate_walk({.duration = 2.0}, {}), generate_walk({.duration = 3.0}, {})),
               InvalidArgument);
}

TEST(WalkerSkeleton, IsABodyOfTheHeightAskedFor) {
  const auto skeleton = walker_skeleton(1.6);
  EXPECT_EQ(skeleton->num_joints(), 21);
  EXPECT_EQ(skeleton->pelvis(), 0);
  const auto world = motion::forward_kinematics(*skeleton, rest_pose(*skeleton));
  const auto head = static_cast<std::size_t>(skeleton->find("Head"));
  EXPECT_NEAR(world.positions[head].y() + skeleton->joint(4).end_site.y(), 1.6, 0.05);
}

}  // namespace
}  // namespace strut::generate
