// SPDX-License-Identifier: MIT
// Footskate cleanup on generated walks, of which footplants are known exactly and in which feet slide by as much as a
// test adds.
#include "sliding_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>
#include <strut/postprocess/footskate.h>

namespace strut::postprocess {
namespace {

using Eigen::Vector3d;
using motion::Footplant;
using testing::HasSubstr;
using testing::SizeIs;

constexpr double kStill = 1e-9;  // of a held foot [m]: closed form, so rounding alone
// Of a walk whose feet stand already [m]: toes and pelvis, and any joint; measured: 1e-3, and 3e-2 of knees that are
// almost straight while a heel that lifts off is still held a little.
constexpr double kUntouched = 2e-3, kAlmostUntouched = 4e-2;
constexpr double kSharpest = 1.5;   // accelerations against the 99th percentile of the clip as it comes; measured: 1.3
constexpr double kUnit = 1e-9;      // rotations stay of unit length
constexpr double kRounding = 1e-9;  // of positions in the world [m]

std::vector<Vector3d> toes(const Motion& clip, const motion::Leg& leg) {
  std::vector<Vector3d> path;
  for (const Pose& pose : clip.frames()) {
    path.push_back(motion::toe_position(leg, motion::forward_kinematics(clip.skeleton(), pose)));
  }
  return path;
}

/// The longest way over the ground from frame to frame while planted [m].
double greatest_slip(const Motion& clip, const motion::Legs& legs, const std::vector<Footplant>& plants) {
  double greatest = 0.0;
  for (const Footplant& plant : plants) {
    const auto path = toes(clip, legs.foot(plant.foot));
    for (int f = plant.begin + 1; f < plant.end; ++f) {
      const Vector3d step = path[at(f)] - path[at(f - 1)];
      greatest = std::max(greatest, std::hypot(step.x(), step.z()));
    }
  }
  return greatest;
}

/// Angular accelerations of a joint in its parent's frame, ascending [rad/s^2].
std::vector<double> accelerations(const Motion& clip, int joint) {
  std::vector<double> found;
  for (int f = 1; f + 1 < clip.num_frames(); ++f) {
    const auto rotation = [&](int g) { return clip.frame(g).rotations[at(joint)]; };
    const Vector3d before = math::log_map(rotation(f) * rotation(f - 1).conjugate());
    const Vector3d after = math::log_map(rotation(f + 1) * rotation(f).conjugate());
    found.push_back((after - before).norm() * clip.frame_rate() * clip.frame_rate());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The clip with the toe joints cut off; the ankles keep an end site where `with_tip`.
Motion without_toes(const Motion& clip, const motion::Legs& legs, bool with_tip) {
  std::vector<Joint> joints;
  std::vector<int> kept;
  std::vector<int> index(at(clip.skeleton().num_joints()), -1);
  for (int j = 0; j < clip.skeleton().num_joints(); ++j) {
    if (j == legs.left.toe || j == legs.right.toe) continue;
    Joint joint = clip.skeleton().joint(j);
    if (joint.parent >= 0) joint.parent = index[at(joint.parent)];
    joint.has_end_site = joint.has_end_site || (with_tip && (j == legs.left.ankle || j == legs.right.ankle));
    if (j == legs.left.ankle) joint.end_site = clip.skeleton().joint(legs.left.toe).offset;
    if (j == legs.right.ankle) joint.end_site = clip.skeleton().joint(legs.right.toe).offset;
    index[at(j)] = static_cast<int>(joints.size());
    joints.push_back(joint);
    kept.push_back(j);
  }
  std::vector<Pose> frames;
  for (const Pose& pose : clip.frames()) {
    frames.emplace_back();
    for (const int j : kept) {
      frames.back().rotations.push_back(pose.rotations[at(j)]);
      frames.back().translations.push_back(pose.translations[at(j)]);
    }
  }
  return {std::make_shared<const Skeleton>(std::move(joints)), clip.frame_rate(), std::move(frames)};
}

// ---- feet -----------------------------------------------------------------------------------------------------------

TEST(Footskate, HeldFeetStandStill) {
  for (const double rate : {30.0, 60.0, 120.0}) {
    const Sliding sliding(0.02, rate);
    EXPECT_GT(greatest_slip(sliding.clip, sliding.legs, sliding.walk.footplants), 1e-3) << "there is nothing to hold";
    EXPECT_LT(greatest_slip(sliding.cleaned(), sliding.legs, sliding.walk.footplants), kStill) << rate;
  }
}

TEST(Footskate, AFlatFootKeepsItsHeel) {
  const Sliding sliding(0.02);
  const Motion cleaned = sliding.cleaned();
  constexpr double kHeelStill = 1.5e-3;  // from frame to frame [m]: the clip slides by 2e-3; measured: 3e-4
  for (const Footplant& plant : sliding.walk.flat_footplants) {
    motion::Leg heel = sliding.legs.foot(plant.foot);
    heel.toe = -1;
    heel.tip.setZero();
    const auto path = toes(cleaned, heel);
    for (int f = plant.begin + 1; f < plant.end; ++f) EXPECT_LT((path[at(f)] - path[at(f - 1)]).norm(), kHeelStill);
  }
}

TEST(Footskate, AWalkThatDoesNotSlideStaysAsItIs) {
  for (const double rate : {30.0, 60.0, 120.0}) {
    const Sliding still(0.0, rate);
    const Motion cleaned = still.cleaned();
    EXPECT_LT(greatest_distance(cleaned, still.clip), kAlmostUntouched) << rate;
    for (int f = 0; f < cleaned.num_frames(); ++f) {
      EXPECT_LT((cleaned.frame(f).translations[0] - still.clip.frame(f).translations[0]).norm(), kUntouched);
    }
    for (const motion::Leg& leg : {still.legs.left, still.legs.right}) {
      const auto before = toes(still.clip, leg), after = toes(cleaned, leg);
      for (std::size_t f = 0; f < before.size(); ++f) EXPECT_LT((after[f] - before[f]).norm(), kUntouched) << f;
    }
  }
}

TEST(Footskate, NothingChangesWithoutFootplants) {
  const Sliding sliding(0.02);
  const Motion again(sliding.clip.shared_skeleton(), sliding.clip.frame_rate(), sliding.clip.frames());
  EXPECT_TRUE(clean_footskate(sliding.clip, sliding.legs, {}).frames() == again.frames());
}

TEST(Footskate, KneesNeverSnap) {
  for (const double amplitude : {0.01, 0.03}) {
    const Sliding sliding(amplitude);
    const Motion cleaned = sliding.cleaned();
    for (const int foot : {0, 1}) {
      const motion::Leg& leg = sliding.legs.foot(foot);
      for (const int joint : {leg.hip, leg.knee, leg.ankle}) {
        const auto usual = accelerations(sliding.clip, joint);
        const double percentile = usual[usual.size() * 99 / 100];
        EXPECT_LT(accelerations(cleaned, joint).back(), kSharpest * percentile) << joint;
      }
    }
  }
}

TEST(Footskate, MovesPelvisAndLegsAlone) {
  const Sliding sliding(0.02);
  const Motion cleaned = sliding.cleaned();
  const auto is_of = [](const motion::Leg& leg, int j) { return j == leg.hip || j == leg.knee || j == leg.ankle; };
  for (int j = 0; j < sliding.clip.skeleton().num_joints(); ++j) {
    const bool is_leg = is_of(sliding.legs.left, j) || is_of(sliding.legs.right, j);
    bool turns = false, moves = false;
    for (int f = 0; f < cleaned.num_frames(); ++f) {
      const Pose &before = sliding.clip.frame(f), &after = cleaned.frame(f);
      turns = turns || after.rotations[at(j)].angularDistance(before.rotations[at(j)]) > kRounding;
      moves = moves || after.translations[at(j)] != before.translations[at(j)];
    }
    EXPECT_EQ(turns, is_leg) << j;
    if (!is_leg) {
      EXPECT_EQ(moves, j == 0) << j;
    }
  }
}

TEST(Footskate, BonesStretchByNoMoreThanAllowed) {
  const Sliding sliding(0.05);
  for (const double allowed : {0.0, 0.02}) {
    const Motion cleaned = sliding.cleaned({.max_stretch = allowed});
    for (const int joint : {sliding.legs.left.knee, sliding.legs.right.ankle}) {
      const double length = sliding.clip.frame(0).translations[at(joint)].norm();
      for (const Pose& pose : cleaned.frames()) {
        EXPECT_LE(pose.translations[at(joint)].norm(), (1.0 + allowed) * length + kRounding);
        EXPECT_GE(pose.translations[at(joint)].norm(), length - kRounding);
      }
    }
  }
}

TEST(Footskate, HoldsFeetWithoutToes) {
  const Sliding sliding(0.02);
  for (const bool with_tip : {false, true}) {
    const Motion clip = without_toes(sliding.clip, sliding.legs, with_tip);
    const auto legs = motion::find_legs(clip).value();
    ASSERT_EQ(legs.left.has_toe(), with_tip);
    const auto& plants = with_tip ? sliding.walk.footplants : sliding.walk.flat_footplants;
    EXPECT_LT(greatest_slip(clean_footskate(clip, legs, plants), legs, plants), kStill);
  }
}

TEST(Footskate, TheGroundMayLieAnywhere) {
  const Sliding sliding(0.02);
  const Vector3d shift(3.0, 0.4, -7.0);
  const Motion moved = motion::moved(sliding.clip, shift, 0.7);
  const Motion cleaned = clean_footskate(moved, sliding.legs, sliding.walk.footplants);
  EXPECT_LT(greatest_distance(cleaned, motion::moved(sliding.cleaned(), shift, 0.7)), 1e-6);
}

TEST(Footskate, AChainAboveThePelvisChangesNothing) {
  const Sliding sliding(0.02);
  std::vector<Joint> joints = sliding.clip.skeleton().joints();
  for (Joint& joint : joints) ++joint.parent;
  joints.insert(joints.begin(), Joint{"carrier", -1, Vector3d::Zero(), false, Vector3d::Zero()});
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.8, Vector3d(1.0, 2.0, 3.0).normalized()));
  std::vector<Pose> frames = sliding.clip.frames();
  for (Pose& pose : frames) {
    pose.rotations[0] = turn.conjugate() * pose.rotations[0];
    pose.translations[0] = turn.conjugate() * pose.translations[0];
    pose.rotations.insert(pose.rotations.begin(), turn);
    pose.translations.insert(pose.translations.begin(), Vector3d::Zero());
  }
  const Motion carried(std::make_shared<const Skeleton>(std::move(joints)), sliding.clip.frame_rate(),
                       std::move(frames));
  const auto legs = motion::find_legs(carried).value();
  const Motion cleaned = clean_footskate(carried, legs, sliding.walk.footplants);
  EXPECT_EQ(cleaned.frame(100).translations[0], Vector3d::Zero());
  const auto x = motion::joint_positions_world(cleaned), y = motion::joint_positions_world(sliding.cleaned());
  for (std::size_t j = 0; j < y[100].size(); ++j) EXPECT_LT((x[100][j + 1] - y[100][j]).norm(), 1e-6);
}

// ---- standing and drifting ------------------------------------------------------------------------------------------

TEST(Footskate, TheBodyStaysOverFeetThatDriftAway) {
  const Sliding standing(0.0, 60.0, 0.0);
  std::vector<Pose> frames;
  for (int f = 0; f < 1200; ++f) {
    frames.push_back(standing.clip.frame(0));
    frames.back().translations[0].x() += 0.05 / 60.0 * f;
  }
  const Motion drifting(standing.clip.shared_skeleton(), 60.0, std::move(frames));
  const auto plants = always(1200);
  Diagnostics diagnostics;
  const Motion cleaned = clean_footskate(drifting, standing.legs, plants, {}, &diagnostics);
  EXPECT_THAT(diagnostics.entries(), SizeIs(0));
  EXPECT_LT(greatest_slip(cleaned, standing.legs, plants), kStill);
  // The pelvis stays behind by the drift times the time in which the body follows.
  EXPECT_LT(std::abs(cleaned.frame(1199).translations[0].x() - cleaned.frame(0).translations[0].x()), 0.01);
}

TEST(Footskate, AFootThatIsDraggedAwayIsLetGo) {
  const Sliding walking(0.0);
  Diagnostics diagnostics;
  const Motion cleaned =
      clean_footskate(walking.clip, walking.legs, {{0, 0, walking.clip.num_frames()}}, {}, &diagnostics);
  ASSERT_THAT(diagnostics.entries(), SizeIs(1));
  EXPECT_THAT(diagnostics.entries()[0].message, HasSubstr("the left foot was let go"));
  EXPECT_LT(greatest_distance(cleaned, walking.clip), 0.6);
}

TEST(Footskate, BothFeetMayStandFromBeginningToEnd) {
  const Sliding standing(0.01, 60.0, 0.0);
  const auto plants = always(standing.clip.num_frames());
  EXPECT_LT(greatest_slip(clean_footskate(standing.clip, standing.legs, plants), standing.legs, plants), kStill);
}

// ---- flicker --------------------------------------------------------------------------------------------------------

TEST(Footskate, FlickerOfTheFlagsIsIgnored) {
  const Sliding sliding(0.02, 30.0);
  const Flags steady = flags_of(sliding.walk.footplants, sliding.clip.num_frames());
  Flags flickering = steady;
  const Footplant& plant = sliding.walk.footplants[1];
  const auto foot = at(plant.foot);
  flickering[at(plant.begin + 4)][foot] = false;  // a gap of one frame,
  flickering[at(plant.end + 3)][foot] = true;     // a footplant of one frame,
  flickering[at(plant.begin + 8)][foot] = false;  // and a gap of two
  flickering[at(plant.begin + 9)][foot] = false;
  ASSERT_FALSE(steady[at(plant.end + 3)][foot]);
  ASSERT_TRUE(steady[at(plant.begin + 10)][foot]);
  FootskateCleaner cleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0);
  const auto expected = streamed(cleaner, sliding.clip, steady);
  EXPECT_TRUE(streamed(cleaner, sliding.clip, flickering) == expected);
}

TEST(Footskate, AlternatingFlagsDoNoHarm) {
  const Sliding sliding(0.02, 30.0);
  Flags flags(at(sliding.clip.num_frames()));
  for (std::size_t f = 0; f < flags.size(); ++f) flags[f] = {f % 2 == 0, f % 5 < 2};
  FootskateCleaner cleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0);
  const Motion cleaned(sliding.clip.shared_skeleton(), 30.0, streamed(cleaner, sliding.clip, flags));
  EXPECT_LT(greatest_distance(cleaned, sliding.clip), 0.5);
}

// ---- legs that are broken -------------------------------------------------------------------------------------------

void expect_sound(const Motion& cleaned) {
  for (const Pose& pose : cleaned.frames()) {
    for (const auto& rotation : pose.rotations) ASSERT_NEAR(rotation.norm(), 1.0, kUnit);
    for (const auto& translation : pose.translations) ASSERT_TRUE(translation.allFinite());
  }
}

TEST(FootskateBrokenLegs, BonesWithoutLength) {
  const Sliding sliding(0.02, 30.0);
  for (const int joint : {sliding.legs.left.knee, sliding.legs.left.ankle, sliding.legs.left.toe}) {
    std::vector<Pose> frames = sliding.clip.frames();
    for (Pose& pose : frames) pose.translations[at(joint)].setZero();
    const Motion broken(sliding.clip.shared_skeleton(), 30.0, std::move(frames));
    expect_sound(clean_footskate(broken, sliding.legs, sliding.walk.footplants));
  }
}

TEST(FootskateBrokenLegs, StraightLegs) {
  const Sliding sliding(0.02, 30.0);
  std::vector<Pose> frames = sliding.clip.frames();
  for (Pose& pose : frames) {
    for (const int joint : {sliding.legs.left.knee, sliding.legs.right.knee}) pose.rotations[at(joint)].setIdentity();
  }
  const Motion straight(sliding.clip.shared_skeleton(), 30.0, std::move(frames));
  const Motion cleaned = clean_footskate(straight, sliding.legs, sliding.walk.footplants);
  expect_sound(cleaned);
  EXPECT_LT(greatest_distance(cleaned, straight), 0.5);
}

TEST(FootskateBrokenLegs, FeetThatJumpOutOfReach) {
  const Sliding sliding(0.02, 30.0);
  std::vector<Pose> frames = sliding.clip.frames();
  for (std::size_t f = 0; f < frames.size(); ++f) frames[f].translations[0].x() += f % 20 < 10 ? 0.0 : 50.0;
  const Motion jumping(sliding.clip.shared_skeleton(), 30.0, std::move(frames));
  expect_sound(clean_footskate(jumping, sliding.legs, sliding.walk.footplants));
}

TEST(Footskate, RefusesFootplantsThatAreNotOfTheClip) {
  const Sliding sliding(0.0, 30.0);
  for (const Footplant& plant :
       std::vector<Footplant>{{2, 0, 5}, {0, -1, 5}, {0, 5, 4}, {0, 0, sliding.clip.num_frames() + 1}}) {
    EXPECT_THROW(clean_footskate(sliding.clip, sliding.legs, {plant}), InvalidArgument);
  }
}

}  // namespace
}  // namespace strut::postprocess
