// SPDX-License-Identifier: MIT
// What walks and gestures share: the joints of the walker's body, where its feet stand, and how arms and legs are
// posed. Signs: X is left, Y up, Z forward; a turn about +X carries what points up to the front; side is +1 left.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/math/rotation.h>
#include <strut/motion/motion.h>

namespace strut::generate::detail {

/// Indices of the walker's joints; left before right, `+ kSide` is the right one.
enum BodyJoint {
  kHips = 0,
  kSpine,
  kChest,
  kNeck,
  kHead,
  kShoulder,
  kUpperArm,
  kForeArm,
  kHand,
  kThigh = 13,
  kShank,
  kFoot,
  kToe,
  kNumBodyJoints = 21,
};
inline constexpr int kSideOfArm = 4;  ///< from a left arm joint to the right one
inline constexpr int kSideOfLeg = 4;  ///< from a left leg joint to the right one

/// Where a foot is.
struct FootState {
  Eigen::Vector3d ankle = Eigen::Vector3d::Zero();  ///< world [m]
  double yaw = 0.0;                                 ///< [rad]
  double pitch = 0.0;                               ///< toes up positive [rad]
  double toe_bend = 0.0;                            ///< of the toes against the foot, up positive [rad]
};

/// How an arm is held [rad]; all zero: hanging, straight.
struct ArmAngles {
  double flexion = 0.0;  ///< of the upper arm, forward
  double spread = 0.0;   ///< of the upper arm, away from the body
  double twist = 0.0;    ///< of the upper arm about its own axis, elbow outwards
  double elbow = 0.0;    ///< bend
  double wrist = 0.0;    ///< bend
};

/// Rotations by an angle [rad] about one axis.
inline Eigen::Quaterniond about_x(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()));
}
inline Eigen::Quaterniond about_y(double angle) {
  return math::rotation_about_y(angle);
}
inline Eigen::Quaterniond about_z(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

/// How high an ankle is above the ground where the sole is flat [m].
double ankle_height(const Skeleton& skeleton);

/// Sets the rotations of one arm (side 0 left, 1 right).
void place_arm(int side, const ArmAngles& arm, Pose& pose);

/// Sets the rotations of one leg: two-bone inverse kinematics in the plane of hip, ankle and `ahead`, the horizontal
/// direction that the knee points to. The pelvis is where the pose says in `position`, `rotation` (world).
void place_leg(const Skeleton& skeleton, int side, const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation,
               const Eigen::Vector3d& ahead, const FootState& foot, Pose& pose);

}  // namespace strut::generate::detail
