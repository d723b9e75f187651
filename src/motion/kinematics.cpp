// SPDX-License-Identifier: MIT
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::motion {

void forward_kinematics(const Skeleton& skeleton, const Pose& pose, WorldPose& world) {
  const auto count = static_cast<std::size_t>(skeleton.num_joints());
  world.rotations.resize(count);
  world.positions.resize(count);
  world.rotations[0] = pose.rotations[0];
  world.positions[0] = pose.translations[0];
  for (std::size_t j = 1; j < count; ++j) {
    const auto parent = static_cast<std::size_t>(skeleton.joints()[j].parent);
    world.rotations[j] = world.rotations[parent] * pose.rotations[j];
    world.positions[j] = world.positions[parent] + world.rotations[parent] * pose.translations[j];
  }
}

WorldPose forward_kinematics(const Skeleton& skeleton, const Pose& pose) {
  WorldPose world;
  forward_kinematics(skeleton, pose, world);
  return world;
}

std::vector<std::vector<Eigen::Vector3d>> joint_positions_world(const Motion& motion) {
  std::vector<std::vector<Eigen::Vector3d>> positions;
  positions.reserve(motion.frames().size());
  WorldPose world;
  for (const Pose& pose : motion.frames()) {
    forward_kinematics(motion.skeleton(), pose, world);
    positions.push_back(world.positions);
  }
  return positions;
}

Motion moved(const Motion& motion, const Eigen::Vector3d& shift, double angle) {
  const Eigen::Quaterniond turn = math::rotation_about_y(angle);
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    pose.rotations[0] = turn * pose.rotations[0];
    pose.translations[0] = turn * pose.translations[0] + shift;
  }
  return {motion.shared_skeleton(), motion.frame_rate(), std::move(frames)};
}

}  // namespace strut::motion
