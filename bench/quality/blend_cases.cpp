// SPDX-License-Identifier: MIT
// The walks of blend_study, and the distance between two cycles.
#include "blend_study.h"

#include <cmath>
#include <numbers>

#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::study {
namespace {

constexpr double kSeconds = 14.0;
constexpr int kPhases = 64;
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kCm = 100.0;

}  // namespace

const std::vector<double>& walker_speeds() {
  static const std::vector<double> speeds{0.6, 0.85, 1.1, 1.35, 1.6};
  return speeds;
}

blend::StyledClip walk_of(const std::string& name, generate::WalkStyle style, double speed, double variation,
                          std::uint64_t seed, double frame_rate) {
  generate::WalkContent content;
  content.duration = kSeconds;
  content.speed = speed;
  style.variation = variation;
  style.seed = seed;
  return {name, generate::generate_walk(content, style, frame_rate).motion, name + " at " + std::to_string(speed)};
}

Pose pose_at(const representation::Representation& representation, const blend::GaitLoop& loop, double phase) {
  FrameMatrix row(1, representation.num_dofs());
  row.row(0) = loop.at(phase).head(representation.num_dofs()).transpose();
  row.leftCols<representation::kHeight>().setZero();
  const auto& skeleton = representation.shared_skeleton();
  return representation::decode(representation, row, 30.0, {}, skeleton, rest_pose(*skeleton)).frame(0);
}

CycleError cycle_error(const representation::Representation& representation, const blend::GaitLoop& a,
                       const blend::GaitLoop& b) {
  double angle = 0.0, position = 0.0;
  motion::WorldPose world_a, world_b;
  for (int k = 0; k < kPhases; ++k) {
    const double phase = static_cast<double>(k) / kPhases;
    const Pose pose_a = pose_at(representation, a, phase), pose_b = pose_at(representation, b, phase);
    motion::forward_kinematics(representation.skeleton(), pose_a, world_a);
    motion::forward_kinematics(representation.skeleton(), pose_b, world_b);
    const double share = 1.0 / (kPhases * static_cast<double>(pose_a.rotations.size()));
    for (std::size_t j = 0; j < pose_a.rotations.size(); ++j) {
      angle += share * std::pow(pose_a.rotations[j].angularDistance(pose_b.rotations[j]), 2);
      position += share * (world_a.positions[j] - world_b.positions[j]).squaredNorm();
    }
  }
  return {kDegrees * std::sqrt(angle), kCm * std::sqrt(position), kCm * std::abs(a.duration() / b.duration() - 1.0)};
}

}  // namespace strut::study
