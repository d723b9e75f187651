// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <strut/core/error.h>
#include <strut/effort/labelled_movement.h>
#include <strut/effort/space_time_blend.h>
#include <strut/motion/legs.h>
#include <strut/representation/relative_root.h>

namespace strut::effort {
namespace {

Motion fragment_motion(const FragmentDatabase& database, RecordId id) {
  const auto fragment = database.find_fragment(id);
  if (!fragment) throw InvalidArgument("target", "the id of a fragment", std::to_string(id));
  return database.motion(*fragment);
}

Motion blend_motion(const FragmentDatabase& database, RecordId id) {
  const std::vector<BlendRecord> blends = database.blends();
  const auto blend = std::find_if(blends.begin(), blends.end(), [&](const BlendRecord& b) { return b.id == id; });
  if (blend == blends.end()) throw InvalidArgument("target", "the id of a blend", std::to_string(id));
  const Motion first = fragment_motion(database, blend->first), second = fragment_motion(database, blend->second);
  return SpaceTimeBlend(first, second).at(blend->alpha).motion;
}

/// Where the movement starts, and the way it faces on the average.
representation::RootPlacement placement_of(const Motion& motion) {
  const Eigen::Quaterniond upright = motion::upright_reference(motion);
  const auto place = [&](const Pose& pose) {
    return representation::placement(representation::pelvis_world(motion.skeleton(), pose), upright);
  };
  double across = 0.0, along = 0.0;
  for (const Pose& pose : motion.frames()) {
    const double heading = place(pose).heading;
    across += std::sin(heading);
    along += std::cos(heading);
  }
  representation::RootPlacement start = place(motion.frame(0));
  start.heading = std::atan2(across, along);
  return start;
}

Motion placed_at_origin(const Motion& motion) {
  const representation::RootPlacement start = placement_of(motion);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-start.heading, Eigen::Vector3d::UnitY()));
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    pose.rotations[0] = turn * pose.rotations[0];
    pose.translations[0] = turn * (pose.translations[0] - Eigen::Vector3d(start.x, 0.0, start.z));
  }
  return {motion.shared_skeleton(), motion.frame_rate(), std::move(frames)};
}

}  // namespace

Motion labelled_movement(const FragmentDatabase& database, const LabelTarget& target) {
  return placed_at_origin(target.kind == TargetKind::kBlend ? blend_motion(database, target.id)
                                                            : fragment_motion(database, target.id));
}

}  // namespace strut::effort
