// SPDX-License-Identifier: MIT
#include "demo_body.h"

#include <algorithm>
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

Footprint footprint(const Motion& motion, const motion::Footplant& plant) {
  const std::string side = plant.foot == 0 ? "Left" : "Right";
  const auto ankle = static_cast<std::size_t>(motion.skeleton().find(side + "Foot"));
  const auto ball = static_cast<std::size_t>(motion.skeleton().find(side + "Toe"));
  const int third = (plant.end - plant.begin) / 3;
  Footprint print{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  int count = 0;
  for (int frame = plant.begin + third; frame < std::max(plant.end - third, plant.begin + third + 1); ++frame) {
    const auto world = motion::forward_kinematics(motion.skeleton(), motion.frame(frame));
    const Eigen::Vector3d forward = world.positions[ball] - world.positions[ankle];
    print.heel += world.positions[ankle] - 0.3 * forward;
    print.toes += world.positions[ball] + 0.5 * forward;
    ++count;
  }
  print.heel /= count;
  print.toes /= count;
  print.heel.y() = print.toes.y() = 0.0;
  return print;
}

}  // namespace strut::cli
