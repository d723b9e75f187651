// SPDX-License-Identifier: MIT
// Poses over time on a skeleton: what files are read into, and what every stage takes and gives.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/motion/skeleton.h>

namespace strut {

/// One frame: every joint's transform in its parent's frame (the root's: in the world).
struct Pose {
  std::vector<Eigen::Quaterniond> rotations;  ///< unit, one per joint
  std::vector<Eigen::Vector3d> translations;  ///< one per joint [m]; the skeleton's offset where the bone is rigid

  friend bool operator==(const Pose& a, const Pose& b) {
    if (a.translations != b.translations || a.rotations.size() != b.rotations.size()) return false;
    for (std::size_t j = 0; j < a.rotations.size(); ++j) {
      if (a.rotations[j].coeffs() != b.rotations[j].coeffs()) return false;
    }
    return true;
  }
};

/// The pose in which no joint is rotated and every bone has its rest offset.
Pose rest_pose(const Skeleton& skeleton);

/// A clip: a skeleton, frames at a uniform rate.
class Motion {
 public:
  /// `frame_rate` in frames per second. Throws InvalidArgument if the skeleton is null, the rate is not positive and
  /// finite, or a pose has another number of joints, a non-finite number, or a rotation that is not of unit length
  /// (within 1e-6; they are normalized). May be empty.
  Motion(std::shared_ptr<const Skeleton> skeleton, double frame_rate, std::vector<Pose> frames = {});

  [[nodiscard]] const Skeleton& skeleton() const noexcept { return *skeleton_; }
  [[nodiscard]] const std::shared_ptr<const Skeleton>& shared_skeleton() const noexcept { return skeleton_; }
  [[nodiscard]] double frame_rate() const noexcept { return frame_rate_; }
  [[nodiscard]] double frame_time() const noexcept { return 1.0 / frame_rate_; }
  [[nodiscard]] int num_frames() const noexcept { return static_cast<int>(frames_.size()); }
  [[nodiscard]] double duration() const noexcept { return num_frames() / frame_rate_; }  ///< [s]
  [[nodiscard]] const Pose& frame(int index) const { return frames_.at(static_cast<std::size_t>(index)); }
  [[nodiscard]] const std::vector<Pose>& frames() const noexcept { return frames_; }

  /// The frames [begin, end) as a motion of their own. Throws InvalidArgument if the range is not inside the motion.
  [[nodiscard]] Motion slice(int begin, int end) const;

 private:
  std::shared_ptr<const Skeleton> skeleton_;
  double frame_rate_;
  std::vector<Pose> frames_;
};

}  // namespace strut
