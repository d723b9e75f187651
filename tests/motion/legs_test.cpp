// SPDX-License-Identifier: MIT
#include "support/data.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/math/rotation.h>
#include <strut/motion/legs.h>

namespace strut::motion {
namespace {

constexpr double kExact = 1e-9;
constexpr double kPi = std::numbers::pi;

// Joints of the body below. Names are meaningless on purpose.
enum Index {
  kRoot,
  kPelvis,
  kSpine,
  kArmA,
  kElbowA,
  kHandA,
  kFingerA,
  kArmB,
  kElbowB,
  kHandB,
  kFingerB,
  kHipA,
  kKneeA,
  kAnkleA,
  kToeA,
  kHipB,
  kKneeB,
  kAnkleB,
  kToeB,
  kCount
};

/// A body facing +Z whose A side is its left: offsets as in a world-aligned standing pose.
std::vector<Joint> standing_joints() {
  return {{"a", -1, {0, 0, 0}},
          {"b", kRoot, {0, 0.95, 0}},
          {"c", kPelvis, {0, 0.4, 0}},
          {"d", kSpine, {0.2, 0.1, 0}},
          {"e", kArmA, {0, -0.3, 0}},
          {"f", kElbowA, {0, -0.25, 0.02}},
          {"g", kHandA, {0, -0.1, 0}},
          {"h", kSpine, {-0.2, 0.1, 0}},
          {"i", kArmB, {0, -0.3, 0}},
          {"j", kElbowB, {0, -0.25, 0.02}},
          {"k", kHandB, {0, -0.1, 0}},
          {"l", kPelvis, {0.1, -0.05, 0}},
          {"m", kHipA, {0, -0.4, 0.02}},
          {"n", kKneeA, {0, -0.42, -0.02}},
          {"o", kAnkleA, {0, -0.06, 0.13}},
          {"p", kPelvis, {-0.1, -0.05, 0}},
          {"q", kHipB, {0, -0.4, 0.02}},
          {"r", kKneeB, {0, -0.42, -0.02}},
          {"s", kAnkleB, {0, -0.06, 0.13}}};
}

/// The same body with every joint's local frame turned at random: the world's positions stay, the rest pose is rubbish.
struct Body {
  std::shared_ptr<const Skeleton> skeleton;
  Pose standing;
};

Body body_with_frames(std::vector<Joint> joints, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Quaterniond> frame(joints.size());
  for (auto& q : frame)
    q = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
  Pose pose;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const int parent = joints[j].parent;
    const Eigen::Quaterniond above =
        parent < 0 ? Eigen::Quaterniond::Identity() : frame[static_cast<std::size_t>(parent)];
    joints[j].offset = above.conjugate() * joints[j].offset;
    joints[j].end_site = frame[j].conjugate() * joints[j].end_site;
    pose.rotations.push_back((above.conjugate() * frame[j]).normalized());
    pose.translations.push_back(joints[j].offset);
  }
  return {std::make_shared<const Skeleton>(joints), pose};
}

Motion still(const Body& body, int frames = 3) {
  return {body.skeleton, 30.0, std::vector<Pose>(static_cast<std::size_t>(frames), body.standing)};
}

TEST(Legs, AreFoundWhateverTheLocalAxesAndTheRestPose) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto legs = find_legs(still(body_with_frames(standing_joints(), seed)));
    ASSERT_TRUE(legs.has_value()) << seed;
    EXPECT_EQ(legs->left.hip, kHipA);
    EXPECT_EQ(legs->left.knee, kKneeA);
    EXPECT_EQ(legs->left.ankle, kAnkleA);
    EXPECT_EQ(legs->left.toe, kToeA);
    EXPECT_EQ(legs->right.hip, kHipB);
    EXPECT_EQ(legs->right.toe, kToeB);
  }
}

TEST(Legs, ChangeSidesWithTheWayTheFeetPoint) {
  auto joints = standing_joints();
  joints[kToeA].offset.z() = joints[kToeB].offset.z() = -0.13;
  const auto legs = find_legs(still(body_with_frames(joints, 1)));
  ASSERT_TRUE(legs.has_value());
  EXPECT_EQ(legs->left.hip, kHipB);
}

TEST(Legs, WithoutFeetAreToldApartByTheKnees) {
  auto joints = standing_joints();
  joints.erase(joints.begin() + kToeB);
  joints.erase(joints.begin() + kToeA);
  for (std::size_t j = kToeA; j < joints.size(); ++j) {
    if (joints[j].parent > kToeA) --joints[j].parent;
  }
  const Body body = body_with_frames(joints, 2);
  const auto legs = find_legs(still(body));
  ASSERT_TRUE(legs.has_value());
  EXPECT_EQ(legs->left.ankle, kAnkleA);
  EXPECT_FALSE(legs->left.has_toe());
  const WorldPose world = forward_kinematics(*body.skeleton, body.standing);
  EXPECT_EQ(toe_position(legs->left, world), world.positions[kAnkleA]);
}

TEST(Legs, TakeAnEndSiteForTheToe) {
  auto joints = standing_joints();
  joints.pop_back();
  joints[kAnkleB].has_end_site = true;
  joints[kAnkleB].end_site = {0, -0.06, 0.13};
  joints.erase(joints.begin() + kToeA);
  for (std::size_t j = kToeA; j < joints.size(); ++j) {
    if (joints[j].parent > kToeA) --joints[j].parent;
  }
  joints[kAnkleA].has_end_site = true;
  joints[kAnkleA].end_site = {0, -0.06, 0.13};
  const Body body = body_with_frames(joints, 3);
  const auto legs = find_legs(still(body));
  ASSERT_TRUE(legs.has_value());
  EXPECT_EQ(legs->left.toe, -1);
  EXPECT_TRUE(legs->left.has_toe());
  const Eigen::Vector3d toe = toe_position(legs->left, forward_kinematics(*body.skeleton, body.standing));
  EXPECT_LT((toe - Eigen::Vector3d(0.1, 0.02, 0.13)).norm(), kExact);
}

TEST(Legs, StartBelowAJointThatOnlyCarriesTheHip) {
  std::vector<Joint> joints = {{"", -1, {0, 0.9, 0}}, {"", 0, {0, 0.4, 0}}};
  for (const double side : {1.0, -1.0}) {
    const int first = static_cast<int>(joints.size());
    joints.push_back({"", 0, {0, 0, 0}});
    joints.push_back({"", first, {0.1 * side, -0.05, 0}});
    joints.push_back({"", first + 1, {0, -0.4, 0}});
    joints.push_back({"", first + 2, {0, -0.4, 0}});
    joints.push_back({"", first + 3, {0, -0.05, 0.15}});
  }
  const auto legs = find_legs(still(body_with_frames(joints, 4)));
  ASSERT_TRUE(legs.has_value());
  EXPECT_EQ(legs->left.hip, 3);
  EXPECT_EQ(legs->left.toe, 6);
  EXPECT_EQ(legs->right.hip, 8);
}

TEST(Legs, AreNotFoundOnBodiesWithoutThem) {
  const auto chain = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"", -1, {0, 1, 0}}, {"", 0, {0, 1, 0}}, {"", 1, {0, 1, 0}}, {"", 0, {0, -1, 0}}});
  EXPECT_FALSE(find_legs(Motion(chain, 30.0, {rest_pose(*chain)})).has_value());
  EXPECT_FALSE(find_legs(Motion(chain, 30.0)).has_value());
  auto uneven = standing_joints();
  uneven[kKneeA].offset.y() = -0.1;  // a wooden leg
  uneven[kAnkleA].offset.y() = -0.72;
  for (const int j : {kHandA, kHandB}) uneven[static_cast<std::size_t>(j)].offset.y() = 0.25;  // and no arm hangs low
  uneven[kElbowA].offset.y() = uneven[kElbowB].offset.y() = 0.3;
  EXPECT_FALSE(find_legs(still(body_with_frames(uneven, 5))).has_value());
}

TEST(Legs, HaveTheirSidesRightInEveryRealClip) {
  STRUT_REQUIRE_REAL_DATA();
  int clips = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::real_data() + "/bandai-namco")) {
    if (entry.path().extension() != ".bvh" || ++clips % 1 != 0)
      continue;  // every fourth: reading them all takes seconds
    const Motion clip = read_bvh(entry.path().string()).motion;
    const auto legs = find_legs(clip);
    ASSERT_TRUE(legs.has_value()) << entry.path();
    EXPECT_EQ(clip.skeleton().joint(legs->left.hip).name, "UpperLeg_L") << entry.path();
    EXPECT_EQ(clip.skeleton().joint(legs->right.toe).name, "Toes_R") << entry.path();
  }
  EXPECT_GT(clips, 100);
}

TEST(UprightReference, GivesTheFacingDirectionAndNoMeanTilt) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Body body = body_with_frames(standing_joints(), seed);
    std::vector<Pose> frames;
    for (int t = 0; t < 60; ++t) {
      Pose pose = body.standing;
      const Eigen::Quaterniond sway = math::exp_map({0.1 * std::sin(2 * kPi * t / 60.0) + 0.2, 0.0, 0.0});
      pose.rotations[0] = math::rotation_about_y(0.1 * t) * sway * pose.rotations[0];
      frames.push_back(pose);
    }
    const Motion clip(body.skeleton, 30.0, frames);
    const Eigen::Quaterniond upright = upright_reference(clip);
    Eigen::Vector3d tilt = Eigen::Vector3d::Zero();
    for (int t = 0; t < 60; ++t) {
      const WorldPose world = forward_kinematics(*body.skeleton, clip.frame(t));
      const Eigen::Quaterniond turned = world.rotations[kPelvis] * upright.conjugate();
      EXPECT_NEAR(math::wrap_angle(math::heading(turned) - 0.1 * t), 0.0, kExact);
      EXPECT_NEAR(math::wrap_angle(facing(*find_legs(clip), world) - 0.1 * t), 0.0, kExact);
      tilt += math::log_map(math::rotation_about_y(-0.1 * t) * turned) / 60.0;
    }
    EXPECT_LT(tilt.norm(), 1e-3);  // means of rotations and of rotation vectors agree to second order
  }
}

TEST(UprightReference, WithoutLegsLevelsThePelvis) {
  const auto chain = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"", -1, {0, 1, 0}}, {"", 0, {0, 1, 0}}, {"", 0, {0, -1, 0}}});
  Pose pose = rest_pose(*chain);
  pose.rotations[0] = math::exp_map({0.5, 0.0, 0.3});
  const Eigen::Quaterniond upright = upright_reference(Motion(chain, 30.0, {pose}));
  const Eigen::Vector3d up = (pose.rotations[0] * upright.conjugate()) * Eigen::Vector3d::UnitY();
  EXPECT_LT((up - Eigen::Vector3d::UnitY()).norm(), kExact);
}

std::string named(int joint) {
  return "joint " + std::to_string(joint);
}

/// A standing body whose joints are called by their numbers.
Motion numbered_body() {
  const Body body = body_with_frames(standing_joints(), 0);
  std::vector<Joint> joints = body.skeleton->joints();
  for (std::size_t j = 0; j < joints.size(); ++j) joints[j].name = named(static_cast<int>(j));
  return {std::make_shared<const Skeleton>(joints), 30.0, {body.standing}};
}

TEST(LegsWithFeet, AreTheNamedOnesWhicheverSideTheyAreOn) {
  const Motion clip = numbered_body();
  const Legs found = *find_legs(clip);
  const Legs swapped = legs_with_feet(clip, named(found.right.toe), named(found.left.ankle));
  EXPECT_EQ(swapped.left.hip, found.right.hip);
  EXPECT_EQ(swapped.left.knee, found.right.knee);
  EXPECT_EQ(swapped.left.ankle, found.right.ankle);
  EXPECT_EQ(swapped.left.toe, found.right.toe);
  EXPECT_EQ(swapped.right.ankle, found.left.ankle);
  EXPECT_EQ(swapped.right.toe, found.left.toe);
}

TEST(LegsWithFeet, RefusesJointsThatAreNoFeet) {
  const Motion clip = numbered_body();
  const std::string foot = named(kAnkleA);
  for (const std::string& other : {std::string("nose"), named(kRoot), named(kPelvis), named(kSpine), named(kHipB),
                                   named(kKneeB), foot, named(kToeA)}) {
    try {
      legs_with_feet(clip, foot, other);
      ADD_FAILURE() << other;
    } catch (const InvalidArgument& error) {
      EXPECT_NE(std::string(error.what()).find("'"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(legs_with_feet(Motion(clip.shared_skeleton(), 30.0), foot, named(kKneeB)), InvalidArgument);
}

TEST(UprightReference, RefusesMotionsWithoutFrames) {
  const Body body = body_with_frames(standing_joints(), 0);
  EXPECT_THROW(upright_reference(Motion(body.skeleton, 30.0)), InvalidArgument);
}

}  // namespace
}  // namespace strut::motion
