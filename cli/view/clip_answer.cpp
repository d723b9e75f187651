// SPDX-License-Identifier: MIT
#include "view/clip_answer.h"

#include "clip_figures.h"
#include "input_files.h"
#include "view/curve_answer.h"
#include "view/workspace.h"

#include <algorithm>
#include <optional>
#include <utility>
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
  const auto& joints = motion.skeleton().joints();
  const auto num_tips = std::count_if(joints.begin(), joints.end(), [](const Joint& j) { return j.has_end_site; });
  std::vector<float> positions;
  positions.reserve(3 * motion.frames().size() * (joints.size() + static_cast<std::size_t>(num_tips)));
  const auto add = [&](const Eigen::Vector3d& place) {
    for (const double x : place) positions.push_back(static_cast<float>(x));
  };
  motion::WorldPose world;
  for (const Pose& pose : motion.frames()) {
    motion::forward_kinematics(motion.skeleton(), pose, world);
    for (const Eigen::Vector3d& place : world.positions) add(place);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].has_end_site) add(world.positions[j] + world.rotations[j] * joints[j].end_site);
    }
  }
  return positions;
}

/// The legs whose feet were named, else those found; nothing, and why among `notes`, for a body without.
std::optional<motion::Legs> legs_of(const std::string& name, const Motion& motion, const FeetOptions& feet,
                                    Diagnostics& notes) {
  if (feet.left.empty() || motion.num_frames() == 0) return motion::find_legs(motion);
  try {
    return cli::legs_of(name, motion, feet);
  } catch (const BadInput& error) {
    notes.warn({}, error.what(), error.hint());
    return std::nullopt;
  }
}

/// None without legs.
std::vector<motion::Footplant> plants_of(const Motion& motion, const std::optional<motion::Legs>& legs) {
  return legs ? postprocess::detect_footplants(motion, *legs) : std::vector<motion::Footplant>{};
}

bool have_same_feet(const std::optional<motion::Legs>& a, const std::optional<motion::Legs>& b) {
  if (!a || !b) return !a && !b;
  return a->left.ankle == b->left.ankle && a->right.ankle == b->right.ankle;
}

/// The plants of one clip.
struct Plants {
  std::vector<motion::Footplant> shown;     ///< of the feet that were named
  std::vector<motion::Footplant> measured;  ///< of those found by shape, as metrics do whatever feet were named
  bool are_same = true;
};

Plants plants_of(const Motion& motion, const std::optional<motion::Legs>& legs, const FeetOptions& feet,
                 Diagnostics& notes) {
  const auto found = feet.left.empty() ? legs : motion::find_legs(motion);
  auto shown = plants_of(motion, legs);
  if (have_same_feet(legs, found)) return {shown, shown, true};
  if (legs && found) {
    notes.note({}, "figures and curves are of the feet found by shape, which are others than those named",
               "footplants are of the feet that --feet names; how far they slide is not shown on the floor");
  }
  return {std::move(shown), plants_of(motion, found), false};
}

/// The point that is the tip of `joint`; the joint itself if it has none.
int tip_of(const Skeleton& skeleton, int joint) {
  const auto& joints = skeleton.joints();
  if (!skeleton.joint(joint).has_end_site) return joint;
  const auto before =
      std::count_if(joints.begin(), joints.begin() + joint, [](const Joint& j) { return j.has_end_site; });
  return skeleton.num_joints() + static_cast<int>(before);
}

Json as_json(const motion::Legs& legs, const Skeleton& skeleton) {
  Json both = Json::array();
  for (const int foot : {0, 1}) {
    const motion::Leg& leg = legs.foot(foot);
    const int toe = leg.toe >= 0 ? leg.toe : tip_of(skeleton, leg.ankle);
    both.push_back({{"hip", leg.hip}, {"knee", leg.knee}, {"ankle", leg.ankle}, {"toe", toe}});
  }
  return both;
}

Json as_json(const std::vector<motion::Footplant>& plants) {
  Json all = Json::array();
  for (const motion::Footplant& plant : plants) {
    all.push_back({{"foot", plant.foot}, {"begin", plant.begin}, {"end", plant.end}});
  }
  return all;
}

/// Relative to the pelvis positions lie within a few metres however far the body travels: 16 bits hold them.
void add_packed(Container& container, std::vector<float> positions, const Motion& motion) {
  const auto stride = positions.size() / static_cast<std::size_t>(motion.num_frames());
  const auto pelvis = 3 * static_cast<std::size_t>(motion.skeleton().pelvis());
  std::vector<float> path, around = positions;
  for (std::size_t begin = 0; begin < positions.size(); begin += stride) {
    for (std::size_t axis = 0; axis < 3; ++axis) path.push_back(positions[begin + pelvis + axis]);
    for (std::size_t i = 0; i < stride; ++i) around[begin + i] -= positions[begin + pelvis + i % 3];
  }
  if (Container::rounding_error(around) > kLargestPackingError) return container.add("positions", positions);
  container.add("pelvisPath", path);
  container.add_rounded("aroundPelvis", around);
}

}  // namespace

Container clip_answer(const std::string& id, const std::string& name, const Motion& motion, Diagnostics notes,
                      Packing packing, const FeetOptions& feet) {
  const auto legs = legs_of(name, motion, feet, notes);
  const Plants plants = plants_of(motion, legs, feet, notes);
  const auto slide = slide_of(motion, plants.are_same ? plants.shown : std::vector<motion::Footplant>{});
  Json header{{"id", id},
              {"name", name},
              {"frameRate", motion.frame_rate()},
              {"numFrames", motion.num_frames()},
              {"points", points_of(motion)},
              {"pelvis", motion.skeleton().pelvis()},
              {"plants", as_json(plants.shown)},
              {"figures", as_json(clip_figures(motion, plants.measured))},
              {"curves", curves_of(motion)},
              {"notes", as_json(notes)}};
  if (legs) header["legs"] = as_json(*legs, motion.skeleton());
  Container container(std::move(header));
  if (packing == Packing::kExact || motion.num_frames() == 0) {
    container.add("positions", positions_of(motion));
    container.add("slide", slide);
  } else {
    add_packed(container, positions_of(motion), motion);
    container.add_rounded("slide", slide);
  }
  return container;
}

}  // namespace strut::cli
