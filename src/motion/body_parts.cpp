// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <strut/core/error.h>
#include <strut/motion/body_parts.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>

namespace strut::motion {
namespace {

// Limbs whose lengths differ by more than this share are no pair.
constexpr double kMirrorTolerance = 0.15;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The body at its first frame, seen so that sideways is one number.
struct Body {
  const Skeleton* skeleton;
  const Pose* pose;
  WorldPose world;
  Eigen::Vector3d left;  // unit

  /// The longest way from the joint's parent down to a leaf [m].
  [[nodiscard]] double length(int joint) const {
    double below = 0.0;
    for (const int child : skeleton->children(joint)) below = std::max(below, length(child));
    return pose->translations[at(joint)].norm() + below;
  }
  /// How far to the left of the joint's parent the limb lies on average [m].
  [[nodiscard]] double side(int joint) const {
    double sum = 0.0;
    int count = 0;
    add_sides(joint, sum, count);
    return sum / count - left.dot(world.positions[at(skeleton->joint(joint).parent)]);
  }

 private:
  void add_sides(int joint, double& sum, int& count) const {
    sum += left.dot(world.positions[at(joint)]);
    ++count;
    for (const int child : skeleton->children(joint)) add_sides(child, sum, count);
  }
};

struct Arms {
  int left = -1, right = -1;
  double length = 0.0;
};

void assign(const Skeleton& skeleton, int joint, BodyPart part, std::vector<BodyPart>& parts) {
  parts[at(joint)] = part;
  for (const int child : skeleton.children(joint)) assign(skeleton, child, part, parts);
}

bool are_mirrored(const Body& body, int a, int b) {
  const double long_one = std::max(body.length(a), body.length(b));
  return std::abs(body.length(a) - body.length(b)) < kMirrorTolerance * long_one && body.side(a) > 0.0 &&
         body.side(b) < 0.0;
}

Arms find_arms(const Body& body, const std::vector<BodyPart>& parts) {
  Arms best;
  for (int joint = body.skeleton->pelvis(); joint < body.skeleton->num_joints(); ++joint) {
    for (const int left : body.skeleton->children(joint)) {
      for (const int right : body.skeleton->children(joint)) {
        if (parts[at(left)] != BodyPart::kTrunk || parts[at(right)] != BodyPart::kTrunk) continue;
        if (!are_mirrored(body, left, right) || body.length(left) <= best.length) continue;
        best = {left, right, body.length(left)};
      }
    }
  }
  return best;
}

}  // namespace

std::vector<BodyPart> body_parts(const Motion& motion) {
  if (motion.num_frames() == 0) throw InvalidArgument("motion", "at least one frame", "none");
  const Skeleton& skeleton = motion.skeleton();
  std::vector<BodyPart> parts(at(skeleton.num_joints()), BodyPart::kTrunk);
  const auto legs = find_legs(motion);
  if (!legs) return parts;
  assign(skeleton, legs->left.hip, BodyPart::kLeftLeg, parts);
  assign(skeleton, legs->right.hip, BodyPart::kRightLeg, parts);
  Body body{&skeleton, &motion.frame(0), forward_kinematics(skeleton, motion.frame(0)), {}};
  const double way = facing(*legs, body.world);
  body.left = {std::cos(way), 0.0, -std::sin(way)};
  const Arms arms = find_arms(body, parts);
  if (arms.left < 0) return parts;
  for (const int child : skeleton.children(skeleton.joint(arms.left).parent)) {
    if (parts[at(child)] == BodyPart::kTrunk) assign(skeleton, child, BodyPart::kHead, parts);
  }
  assign(skeleton, arms.left, BodyPart::kLeftArm, parts);
  assign(skeleton, arms.right, BodyPart::kRightArm, parts);
  return parts;
}

}  // namespace strut::motion
