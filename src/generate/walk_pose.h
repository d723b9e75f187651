// SPDX-License-Identifier: MIT
// From a plan of steps to the body at one content time: feet by their roll on the ground, legs by inverse kinematics,
// pelvis and upper body by waves of the gait phase.
#pragma once

#include "body_pose.h"
#include "walk_plan.h"

#include <memory>

#include <strut/motion/motion.h>

namespace strut::generate::detail {

/// Poses of one walk.
class WalkPoser {
 public:
  /// Throws InvalidArgument if the legs cannot reach the steps.
  WalkPoser(const WalkContent& content, const WalkStyle& style, std::shared_ptr<const Skeleton> skeleton);

  [[nodiscard]] Pose pose(double s) const;
  [[nodiscard]] const WalkPlan& plan() const noexcept { return plan_; }
  [[nodiscard]] FootState foot(int foot, double phase) const;

 private:
  struct Pelvis {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // y: the wave alone, without the base height
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    double twist = 0.0;  // about Y, against the heading
    double list = 0.0;   // about Z
  };

  [[nodiscard]] Pelvis pelvis(double s) const;
  [[nodiscard]] double bad_stance(double phase) const;
  [[nodiscard]] double reachable_height(double s) const;
  [[nodiscard]] math::SmoothCurve base_height(double duration) const;
  void pose_upper_body(double s, const Pelvis& pelvis, Pose& pose) const;
  void pose_arm(double s, int side, Pose& pose) const;
  void pose_leg(double s, int side, const Pelvis& pelvis, Pose& pose) const;
  [[nodiscard]] const Eigen::Vector3d& offset(int joint) const { return skeleton_->joint(joint).offset; }

  WalkStyle style_;
  Schedule direction_;
  std::shared_ptr<const Skeleton> skeleton_;
  WalkPlan plan_;
  math::SmoothCurve base_height_;
};

}  // namespace strut::generate::detail
