// SPDX-License-Identifier: MIT
// The legs of a body and the way it faces, found from its shape and a motion: never from the joints' names or the axes
// the bones lie along, and no rest pose is assumed. Of the chains below the pelvis, the legs are the two mirrored ones
// whose ends are lowest over the motion; left and right follow from the feet, which point forward.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/motion/kinematics.h>
#include <strut/motion/motion.h>

namespace strut::motion {

/// One leg, as joints of a skeleton. Thigh (hip to knee) and shin (knee to ankle) are single bones.
struct Leg {
  int hip = -1;    ///< joint index
  int knee = -1;   ///< joint index, child of hip
  int ankle = -1;  ///< joint index, child of knee
  int toe = -1;    ///< joint index, child of ankle; -1 where the foot has no joint of its own
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< where toe is -1: the file's end site, in the ankle's frame [m];
                                                  ///< zero where there is none

  [[nodiscard]] bool has_toe() const noexcept { return toe >= 0 || !tip.isZero(); }
};

/// The two legs of a body.
struct Legs {
  Leg left, right;

  /// 0 = left, 1 = right, as in annotation.h.
  [[nodiscard]] const Leg& foot(int index) const noexcept { return index == 0 ? left : right; }
};

/// The legs of the body that `motion` moves: its skeleton's shape and its frames are looked at, its joint names are
/// not. Nothing is returned for a motion without frames and for a body without two mirrored legs of at least two bones
/// each, ending below the pelvis. Cost O(frames x joints + leaves^2).
std::optional<Legs> find_legs(const Motion& motion);

/// The legs that end in the joints named `left` and `right`, for a body of which find_legs finds others or none: each
/// name is of an ankle, or of a toe (a child of the ankle). Of the joints from the pelvis down to it, thigh and shin
/// are the two consecutive bones that are longest together. Throws InvalidArgument, naming the joint, if the motion has
/// no frame, there is no such joint, both are one, or it has no leg (hip, knee and ankle) above it. Cost O(frames x
/// joints).
Legs legs_with_feet(const Motion& motion, const std::string& left, const std::string& right);

/// The toe's position in the world [m]; the ankle's where the leg has no toe.
Eigen::Vector3d toe_position(const Leg& leg, const WorldPose& world);

/// The way the body faces: the angle [rad], in (-pi, pi], about the vertical from +Z towards +X, square to the line
/// between the hips.
double facing(const Legs& legs, const WorldPose& world);

/// The pelvis's rotation in the world when the body stands upright, facing +Z (`upright` of
/// representation/relative_root.h): for a pelvis rotation R, math::heading(R * upright.conjugate()) is the way the body
/// faces, and what is left of R * upright.conjugate() without it is the tilt, zero in the mean over the motions.
/// For a body without legs the pelvis's mean upward direction becomes Y; its heading is then right up to a constant.
/// `motions`: clips of one skeleton. Throws InvalidArgument if there is no frame. Cost O(frames x joints).
Eigen::Quaterniond upright_reference(const std::vector<Motion>& motions);

/// The same from one motion.
Eigen::Quaterniond upright_reference(const Motion& motion);

}  // namespace strut::motion
