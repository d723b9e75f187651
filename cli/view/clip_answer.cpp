// SPDX-License-Identifier: MIT
#include "view/clip_answer.h"

#include "view/curve_answer.h"
#include "view/workspace.h"

#include <array>
#include <optional>
#include <vector>

#include <strut/motion/annotation.h>
#include <strut/motion/body_parts.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::cli {
namespace {

using Json = Container::Json;

const char* side_of(motion::BodyPart part) {
  switch (part) {
    case motion::BodyPart::kLeftArm:
    case motion::BodyPart::kLeftLeg:
      return "left";
    case motion::BodyPart::kRightArm:
    case motion::BodyPart::kRightLeg:
      return "right";
    default:
      return "centre";
  }
}

Json points_of(const Motion& motion) {
  const auto& joints = motion.skeleton().joints();
  const auto parts =
      motion.num_frames() == 0 ? std::vector(joints.size(), motion::BodyPart::kTrunk) : motion::body_parts(motion);
  Json points = Json::array();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    points.push_back(
        {{"name", joints[j].name}, {"parent", joints[j].parent}, {"side", side_of(parts[j])}, {"isTip", false}});
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!joints[j].has_end_site) continue;
    points.push_back({{"name", joints[j].name + " tip"}, {"parent", j}, {"side", side_of(parts[j])}, {"isTip", true}});
  }
  return points;
}

std::vector<float> positions_of(const Motion& motion) {
  std::vector<float> positions;
  const auto add = [&](const Eigen::Vector3d& place) {
    for (const double x : place) positions.push_back(static_cast<float>(x));
  };
  motion::WorldPose world;
  for (const Pose& pose : motion.frames()) {
    motion::forward_kinematics(motion.skeleton(), pose, world);
    for (const Eigen::Vector3d& place : world.positions) add(place);
    for (std::size_t j = 0; j < world.positions.size(); ++j) {
      const Joint& joint = motion.skeleton().joints()[j];
      if (joint.has_end_site) add(world.positions[j] + world.rotations[j] * joint.end_site);
    }
  }
  return positions;
}

}  // namespace

Container clip_answer(const std::string& id, const std::string& name, const Motion& motion, const Diagnostics& notes) {
  Json plants = Json::array();
  std::vector<motion::Footplant> footplants;
  if (const auto legs = motion::find_legs(motion)) footplants = postprocess::detect_footplants(motion, *legs);
  for (const motion::Footplant& plant : footplants) {
    plants.push_back({{"foot", plant.foot}, {"begin", plant.begin}, {"end", plant.end}});
  }
  Container container({{"id", id},
                       {"name", name},
                       {"frameRate", motion.frame_rate()},
                       {"numFrames", motion.num_frames()},
                       {"points", points_of(motion)},
                       {"pelvis", motion.skeleton().pelvis()},
                       {"plants", plants},
                       {"figures", Json::array()},
                       {"curves", curves_of(motion)},
                       {"notes", as_json(notes)}});
  container.add("positions", positions_of(motion));
  container.add("slide", slide_of(motion, footplants));
  return container;
}

}  // namespace strut::cli
