// SPDX-License-Identifier: MIT
// Chains are compared by bone lengths measured in the motion itself, since files may carry positions for inner joints.
#include <algorithm>
#include <cmath>
#include <limits>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/motion/legs.h>

namespace strut::motion {
namespace {

// Two chains are mirrored if their bones' lengths differ by less than this share of the whole chain.
constexpr double kMirrorTolerance = 0.15;
// Bones shorter than this share of the chain are no bones: joints on one spot.
constexpr double kBoneShare = 0.02;
// Hips nearer to each other than this share of the legs' length do not tell which way is sideways.
constexpr double kHipShare = 0.02;
// An ankle within this share of the leg's length of its lowest place is near the ground.
constexpr double kGroundShare = 0.1;

using Chain = std::vector<int>;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// What of a motion the search looks at.
struct Shape {
  const Skeleton* skeleton;
  std::vector<WorldPose> world;     // per frame
  std::vector<double> bone_length;  // mean distance to the parent, per joint [m]
  std::vector<double> height;       // mean height, per joint [m]
};

Shape measure(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  Shape shape{
      &skeleton, {}, std::vector<double>(at(skeleton.num_joints())), std::vector<double>(at(skeleton.num_joints()))};
  const double weight = 1.0 / motion.num_frames();
  for (const Pose& pose : motion.frames()) {
    shape.world.push_back(forward_kinematics(skeleton, pose));
    const WorldPose& world = shape.world.back();
    for (int j = 0; j < skeleton.num_joints(); ++j) {
      shape.bone_length[at(j)] += weight * pose.translations[at(j)].norm();
      shape.height[at(j)] += weight * world.positions[at(j)].y();
    }
  }
  return shape;
}

/// From just below the pelvis to each joint without children.
std::vector<Chain> chains_below_pelvis(const Skeleton& skeleton) {
  std::vector<Chain> chains;
  for (int j = skeleton.pelvis() + 1; j < skeleton.num_joints(); ++j) {
    if (!skeleton.children(j).empty()) continue;
    Chain chain;
    for (int k = j; k != skeleton.pelvis() && k >= 0; k = skeleton.joint(k).parent) chain.push_back(k);
    std::reverse(chain.begin(), chain.end());
    chains.push_back(chain);
  }
  return chains;
}

void drop_shared_start(Chain& a, Chain& b) {
  const auto split = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  a.erase(a.begin(), split.first);
  b.erase(b.begin(), split.second);
}

bool are_mirrored(const Shape& shape, const Chain& a, const Chain& b) {
  if (a.size() != b.size()) return false;
  double total = 0.0;
  double apart = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    total += 0.5 * (shape.bone_length[at(a[i])] + shape.bone_length[at(b[i])]);
    apart += std::abs(shape.bone_length[at(a[i])] - shape.bone_length[at(b[i])]);
  }
  return apart < kMirrorTolerance * total;
}

double horizontal_distance(const Shape& shape, int joint, int from) {
  double sum = 0.0;
  for (const WorldPose& world : shape.world) {
    const Eigen::Vector3d d = world.positions[at(joint)] - world.positions[at(from)];
    sum += std::hypot(d.x(), d.z());
  }
  return sum / static_cast<double>(shape.world.size());
}

/// Of the ankle's children the one that reaches out farthest is the toe: others may be heels or toes beside it.
void find_toe(const Shape& shape, double leg_length, Leg& leg) {
  double farthest = kBoneShare * leg_length;
  for (const int child : shape.skeleton->children(leg.ankle)) {
    const double reach = horizontal_distance(shape, child, leg.ankle);
    if (reach <= farthest) continue;
    farthest = reach;
    leg.toe = child;
  }
  const Joint& ankle = shape.skeleton->joint(leg.ankle);
  const bool has_tip = ankle.has_end_site && ankle.end_site.norm() > kBoneShare * leg_length;
  if (leg.toe < 0 && has_tip) leg.tip = ankle.end_site;
}

/// Thigh and shin are the chain's two consecutive bones that are longest together.
std::optional<Leg> leg_of(const Shape& shape, const Chain& chain) {
  std::optional<Leg> leg;
  double longest = 0.0;
  for (std::size_t i = 0; i + 2 < chain.size(); ++i) {
    const double thigh = shape.bone_length[at(chain[i + 1])];
    const double shin = shape.bone_length[at(chain[i + 2])];
    if (thigh + shin <= longest || std::min(thigh, shin) < kBoneShare * (thigh + shin)) continue;
    longest = thigh + shin;
    leg = Leg{chain[i], chain[i + 1], chain[i + 2], -1, Eigen::Vector3d::Zero()};
  }
  if (leg) find_toe(shape, longest, *leg);
  return leg;
}

/// Where the knee bends: ahead of the line from hip to ankle.
Eigen::Vector3d knee_bend(const Leg& leg, const WorldPose& world) {
  return world.positions[at(leg.knee)] - 0.5 * (world.positions[at(leg.hip)] + world.positions[at(leg.ankle)]);
}

/// Where the foot points while it is near the ground; nowhere while it swings, when it may point backward.
Eigen::Vector3d planted_foot(const Leg& leg, const WorldPose& world, double ground) {
  if (!leg.has_toe() || world.positions[at(leg.ankle)].y() > ground) return Eigen::Vector3d::Zero();
  return toe_position(leg, world) - world.positions[at(leg.ankle)];
}

/// Below it the ankle counts as near the ground [m].
double near_ground(const Shape& shape, const Leg& leg) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const WorldPose& world : shape.world) lowest = std::min(lowest, world.positions[at(leg.ankle)].y());
  return lowest + kGroundShare * (shape.bone_length[at(leg.knee)] + shape.bone_length[at(leg.ankle)]);
}

Eigen::Vector3d across_hips(const Leg& left, const Leg& right, const WorldPose& world) {
  Eigen::Vector3d across = world.positions[at(left.hip)] - world.positions[at(right.hip)];
  across.y() = 0.0;
  return across;
}

/// Left is where the body's forward direction is square to the line from right hip to left hip.
std::optional<Legs> tell_left_from_right(const Shape& shape, const Leg& one, const Leg& other) {
  const double ground_of_one = near_ground(shape, one);
  const double ground_of_other = near_ground(shape, other);
  double forward = 0.0;
  double apart = 0.0;
  for (const WorldPose& world : shape.world) {
    const Eigen::Vector3d across = across_hips(one, other, world);
    const Eigen::Vector3d feet = planted_foot(one, world, ground_of_one) + planted_foot(other, world, ground_of_other);
    const Eigen::Vector3d knees = knee_bend(one, world) + knee_bend(other, world);
    forward += across.cross(Eigen::Vector3d::UnitY()).dot(feet + knees);
    apart += across.norm();
  }
  const double leg_length = shape.bone_length[at(one.knee)] + shape.bone_length[at(one.ankle)];
  if (apart < kHipShare * leg_length * static_cast<double>(shape.world.size())) return std::nullopt;
  return forward >= 0.0 ? Legs{one, other} : Legs{other, one};
}

std::vector<Eigen::Quaterniond> pelvis_rotations(const Motion& motion) {
  std::vector<Eigen::Quaterniond> rotations;
  WorldPose world;
  for (const Pose& pose : motion.frames()) {
    forward_kinematics(motion.skeleton(), pose, world);
    rotations.push_back(world.rotations[at(motion.skeleton().pelvis())]);
  }
  return rotations;
}

Eigen::Quaterniond upright_without_legs(const std::vector<Motion>& motions) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const Motion& motion : motions) {
    for (const auto& rotation : pelvis_rotations(motion)) up += rotation.conjugate() * Eigen::Vector3d::UnitY();
  }
  // A body that tumbles has no mean upward direction.
  if (up.norm() < 1e-9) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitY());
}

/// From just below the pelvis down to `joint`; empty if that is not below it.
Chain chain_to(const Skeleton& skeleton, int joint) {
  Chain chain;
  int k = joint;
  for (; k >= 0 && k != skeleton.pelvis(); k = skeleton.joint(k).parent) chain.push_back(k);
  if (k < 0) chain.clear();
  std::reverse(chain.begin(), chain.end());
  return chain;
}

Leg leg_with_foot(const Shape& shape, const std::string& name) {
  const int joint = shape.skeleton->find(name);
  if (joint < 0) throw InvalidArgument("feet", "names of the skeleton's joints", "'" + name + "', which it lacks");
  std::optional<Leg> leg = leg_of(shape, chain_to(*shape.skeleton, joint));
  if (leg && shape.height[at(leg->ankle)] >= shape.height[at(leg->hip)]) leg.reset();  // a head, say
  const bool is_toe = leg && shape.skeleton->joint(joint).parent == leg->ankle;
  if (!leg || (joint != leg->ankle && !is_toe)) {
    throw InvalidArgument("feet", "ankles or toes with a leg (hip, knee and ankle) above them", "'" + name + "'");
  }
  if (is_toe) {
    leg->toe = joint;
    leg->tip.setZero();
  }
  return *leg;
}

}  // namespace

Legs legs_with_feet(const Motion& motion, const std::string& left, const std::string& right) {
  if (motion.num_frames() == 0) throw InvalidArgument("motion", "at least one frame", "none");
  const Shape shape = measure(motion);
  Legs legs{leg_with_foot(shape, left), leg_with_foot(shape, right)};
  if (legs.left.ankle == legs.right.ankle) throw InvalidArgument("feet", "two feet", "'" + left + "' twice");
  return legs;
}

std::optional<Legs> find_legs(const Motion& motion) {
  if (motion.num_frames() == 0) return std::nullopt;
  const Shape shape = measure(motion);
  const double pelvis_height = shape.height[at(shape.skeleton->pelvis())];
  const std::vector<Chain> chains = chains_below_pelvis(*shape.skeleton);
  std::optional<Legs> legs;
  double lowest = 2.0 * pelvis_height;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    for (std::size_t k = i + 1; k < chains.size(); ++k) {
      const double height = shape.height[at(chains[i].back())] + shape.height[at(chains[k].back())];
      if (height >= lowest) continue;
      Chain a = chains[i];
      Chain b = chains[k];
      drop_shared_start(a, b);
      if (!are_mirrored(shape, a, b)) continue;
      const auto one = leg_of(shape, a);
      const auto other = leg_of(shape, b);
      if (!one || !other) continue;
      const auto found = tell_left_from_right(shape, *one, *other);
      if (!found) continue;
      legs = found;
      lowest = height;
    }
  }
  return legs;
}

Eigen::Vector3d toe_position(const Leg& leg, const WorldPose& world) {
  if (leg.toe >= 0) return world.positions[at(leg.toe)];
  return world.positions[at(leg.ankle)] + world.rotations[at(leg.ankle)] * leg.tip;
}

double facing(const Legs& legs, const WorldPose& world) {
  const Eigen::Vector3d forward = across_hips(legs.left, legs.right, world).cross(Eigen::Vector3d::UnitY());
  return math::wrap_angle(std::atan2(forward.x(), forward.z()));
}

Eigen::Quaterniond upright_reference(const std::vector<Motion>& motions) {
  std::optional<Legs> legs;
  bool has_frames = false;
  for (const Motion& motion : motions) {
    has_frames = has_frames || motion.num_frames() > 0;
    if (!legs) legs = find_legs(motion);
  }
  if (!has_frames) throw InvalidArgument("motions", "at least one frame", "none");
  if (!legs) return upright_without_legs(motions);
  std::vector<Eigen::Quaterniond> level;
  for (const Motion& motion : motions) {
    for (const Pose& pose : motion.frames()) {
      const WorldPose world = forward_kinematics(motion.skeleton(), pose);
      level.push_back(math::rotation_about_y(-facing(*legs, world)) * world.rotations[at(motion.skeleton().pelvis())]);
    }
  }
  return math::mean_rotation(level);
}

Eigen::Quaterniond upright_reference(const Motion& motion) {
  return upright_reference(std::vector<Motion>{motion});
}

}  // namespace strut::motion
