// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string>

#include <strut/core/error.h>
#include <strut/math/aligned.h>
#include <strut/math/rotation_arrays.h>
#include <strut/motion/joint_curves.h>
#include <strut/motion/kinematics.h>

namespace strut::motion {
namespace {

constexpr double kLeastShift = 1e-4;  // [m]; less is how many decimals the file has

std::size_t index_of(const Motion& motion, int joint) {
  if (joint < 0 || joint >= motion.skeleton().num_joints()) {
    throw InvalidArgument("joint", "an index below " + std::to_string(motion.skeleton().num_joints()),
                          std::to_string(joint));
  }
  return static_cast<std::size_t>(joint);
}

}  // namespace

FrameMatrix rotation_curve(const Motion& motion, int joint) {
  const std::size_t at = index_of(motion, joint);
  FrameMatrix curve(motion.num_frames(), 3);
  // The maps take eight at once; seven of them turn by nothing.
  std::array<double, 4 * math::kLanes> planes{};
  std::array<double, 3 * math::kLanes> vectors{};
  for (Eigen::Index row = 0; row < curve.rows(); ++row) {
    const Eigen::Quaterniond& rotation = motion.frame(static_cast<int>(row)).rotations[at];
    math::to_planes(1, math::kLanes, rotation.coeffs().data(), planes.data());
    math::log_maps_near(math::kLanes, math::kLanes, planes.data(), vectors.data());
    curve.row(row) << vectors[0], vectors[math::kLanes], vectors[2 * math::kLanes];
  }
  return curve;
}

FrameMatrix position_curve(const Motion& motion, int joint) {
  const std::size_t at = index_of(motion, joint);
  FrameMatrix curve(motion.num_frames(), 3);
  WorldPose world;
  for (Eigen::Index row = 0; row < curve.rows(); ++row) {
    forward_kinematics(motion.skeleton(), motion.frame(static_cast<int>(row)), world);
    curve.row(row) = world.positions[at].transpose();
  }
  return curve;
}

FrameMatrix translation_curve(const Motion& motion, int joint) {
  const std::size_t at = index_of(motion, joint);
  FrameMatrix curve(motion.num_frames(), 3);
  for (Eigen::Index row = 0; row < curve.rows(); ++row) {
    curve.row(row) = motion.frame(static_cast<int>(row)).translations[at].transpose();
  }
  return curve;
}

bool moves_in_parent(const Motion& motion, int joint) {
  const std::size_t at = index_of(motion, joint);
  const Joint& rest = motion.skeleton().joints()[at];
  const auto moves = [&](const Pose& pose) { return (pose.translations[at] - rest.offset).norm() > kLeastShift; };
  return rest.parent >= 0 && std::any_of(motion.frames().begin(), motion.frames().end(), moves);
}

}  // namespace strut::motion
