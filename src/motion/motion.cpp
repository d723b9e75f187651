// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <strut/core/error.h>
#include <strut/motion/motion.h>

namespace strut {
namespace {

constexpr double kUnitLengthTolerance = 1e-6;  // a product of twenty rounded unit quaternions stays within 1e-14

constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

void check_and_normalize(Pose& pose, int num_joints, std::size_t frame) {
  const std::string which = "frames[" + std::to_string(frame) + "]";
  const auto expected = static_cast<std::size_t>(num_joints);
  if (pose.rotations.size() != expected || pose.translations.size() != expected) {
    throw InvalidArgument(which, std::to_string(expected) + " joints",
                          std::to_string(pose.rotations.size()) + " rotations and " +
                              std::to_string(pose.translations.size()) + " translations");
  }
  for (std::size_t j = 0; j < expected; ++j) {
    const double length = pose.rotations[j].norm();
    if (!std::isfinite(length) || !pose.translations[j].allFinite()) {
      throw InvalidArgument(which, "finite numbers", "NaN or infinity at joint " + std::to_string(j));
    }
    if (std::abs(length - 1.0) > kUnitLengthTolerance) {
      throw InvalidArgument(which, "unit rotations",
                            "one of length " + std::to_string(length) + " at joint " + std::to_string(j));
    }
    // One that is of unit length up to rounding stays as it is, to the bit: dividing would only round it again.
    if (std::abs(length - 1.0) > kRounding) pose.rotations[j].coeffs() /= length;
  }
}

}  // namespace

Pose rest_pose(const Skeleton& skeleton) {
  Pose pose;
  pose.rotations.assign(static_cast<std::size_t>(skeleton.num_joints()), Eigen::Quaterniond::Identity());
  for (const Joint& joint : skeleton.joints()) pose.translations.push_back(joint.offset);
  return pose;
}

Motion::Motion(std::shared_ptr<const Skeleton> skeleton, double frame_rate, std::vector<Pose> frames)
    : skeleton_(std::move(skeleton)), frame_rate_(frame_rate), frames_(std::move(frames)) {
  if (!skeleton_) throw InvalidArgument("skeleton", "a skeleton", "null");
  if (!(std::isfinite(frame_rate_) && frame_rate_ > 0.0)) {
    throw InvalidArgument("frame_rate", "a positive number of frames per second", std::to_string(frame_rate_));
  }
  for (std::size_t i = 0; i < frames_.size(); ++i) check_and_normalize(frames_[i], skeleton_->num_joints(), i);
}

Motion Motion::slice(int begin, int end) const {
  if (begin < 0 || end < begin || end > num_frames()) {
    throw InvalidArgument("frames", "a range inside 0 to " + std::to_string(num_frames()),
                          std::to_string(begin) + " to " + std::to_string(end));
  }
  return {skeleton_, frame_rate_, {frames_.begin() + begin, frames_.begin() + end}};
}

}  // namespace strut
