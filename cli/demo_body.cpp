// SPDX-License-Identifier: MIT
#include "demo_body.h"

#include <string>

#include <strut/motion/kinematics.h>

namespace strut::cli {
namespace {

int side_of(const std::string& name) {
  if (name.rfind("Left", 0) == 0) return 1;
  return name.rfind("Right", 0) == 0 ? 2 : 0;
}

}  // namespace

BodyDrawing body_drawing(const Skeleton& skeleton) {
  BodyDrawing drawing;
  for (const Joint& joint : skeleton.joints()) {
    drawing.parents.push_back(joint.parent);
    drawing.sides.push_back(side_of(joint.name));
  }
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    if (!skeleton.joint(j).has_end_site) continue;
    if (skeleton.joint(j).name == "Head") drawing.head = static_cast<int>(drawing.parents.size());
    drawing.parents.push_back(j);
    drawing.sides.push_back(side_of(skeleton.joint(j).name));
  }
  return drawing;
}

std::vector<Eigen::Vector3d> body_points(const Skeleton& skeleton, const Pose& pose) {
  const motion::WorldPose world = motion::forward_kinematics(skeleton, pose);
  std::vector<Eigen::Vector3d> points = world.positions;
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    if (!skeleton.joint(j).has_end_site) continue;
    const auto index = static_cast<std::size_t>(j);
    points.emplace_back(world.positions[index] + world.rotations[index] * skeleton.joint(j).end_site);
  }
  return points;
}

}  // namespace strut::cli
