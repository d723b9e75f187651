// SPDX-License-Identifier: MIT
// Forward kinematics: from joint transforms in the parents' frames to the world.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/motion/motion.h>

namespace strut::motion {

/// Every joint's transform in the world.
struct WorldPose {
  std::vector<Eigen::Quaterniond> rotations;  ///< one per joint
  std::vector<Eigen::Vector3d> positions;     ///< one per joint [m]
};

/// World transforms of one frame. Cost O(joints).
WorldPose forward_kinematics(const Skeleton& skeleton, const Pose& pose);

/// The same into an existing buffer; allocates only when it is too small.
void forward_kinematics(const Skeleton& skeleton, const Pose& pose, WorldPose& world);

/// World positions of all joints over a motion: result[frame][joint] [m].
std::vector<std::vector<Eigen::Vector3d>> joint_positions_world(const Motion& motion);

/// `motion` turned about the vertical axis through the origin by `angle` [rad], then moved by `shift` [m].
Motion moved(const Motion& motion, const Eigen::Vector3d& shift, double angle);

}  // namespace strut::motion
