// SPDX-License-Identifier: MIT
// Motions as signals (Hsu et al. 2005, 4.1): the root relative to the previous frame, every other joint as the
// exponential map of its rotation relative to its mean orientation in the examples. Rows carry physical units (radians,
// metres, per second); normalization.h scales them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>
#include <strut/representation/relative_root.h>

namespace strut::representation {

/// How the motions of one style are written as rows: [root (kNumRootDofs), then 3 per joint below the pelvis].
class Representation {
 public:
  /// `mean_rotations`: one unit quaternion per joint of `skeleton`; `upright`: as in relative_root.h; `travel_joint`:
  /// the joint of the chain down to the pelvis whose translation carries the body about. Throws InvalidArgument if the
  /// sizes or the joint do not fit the skeleton.
  Representation(std::shared_ptr<const Skeleton> skeleton, std::vector<Eigen::Quaterniond> mean_rotations,
                 Eigen::Quaterniond upright, int travel_joint);

  [[nodiscard]] const Skeleton& skeleton() const noexcept { return *skeleton_; }
  [[nodiscard]] const std::shared_ptr<const Skeleton>& shared_skeleton() const noexcept { return skeleton_; }
  [[nodiscard]] const std::vector<Eigen::Quaterniond>& mean_rotations() const noexcept { return mean_rotations_; }
  [[nodiscard]] const Eigen::Quaterniond& upright() const noexcept { return upright_; }
  [[nodiscard]] int travel_joint() const noexcept { return travel_joint_; }

  [[nodiscard]] int num_dofs() const noexcept { return kNumRootDofs + 3 * static_cast<int>(joints_.size()); }
  /// The joints below the pelvis, in the order of their degrees of freedom.
  [[nodiscard]] const std::vector<int>& joints() const noexcept { return joints_; }
  /// "root forward velocity", "Spine x", ...
  [[nodiscard]] std::string dof_name(int dof) const;

 private:
  std::shared_ptr<const Skeleton> skeleton_;
  std::vector<Eigen::Quaterniond> mean_rotations_;
  Eigen::Quaterniond upright_;
  int travel_joint_;
  std::vector<int> joints_;
};

/// The representation whose mean orientations are those of `motions` (same hierarchy, at least one frame in all).
/// Throws InvalidArgument if there is no frame, SkeletonMismatch if the hierarchies differ. Cost O(frames x joints).
Representation fit_representation(const std::vector<Motion>& motions, const Eigen::Quaterniond& upright);

/// A whole motion as rows: frames x num_dofs. The first row has the second's velocities.
/// Throws SkeletonMismatch if the hierarchy differs from the representation's.
FrameMatrix encode(const Representation& representation, const Motion& motion);

/// Rows (frames x num_dofs) as a motion that starts at `start`, with the bones of `bones` on `skeleton`.
/// encode then decode is the identity up to rounding. Throws InvalidArgument if the width is not num_dofs.
Motion decode(const Representation& representation, const Eigen::Ref<const FrameMatrix>& rows, double frame_rate,
              const RootPlacement& start, const std::shared_ptr<const Skeleton>& skeleton, const Pose& bones);

/// The body in its mean orientations, upright, facing +Z, with its rest bones.
Pose mean_pose(const Representation& representation);

/// Throws SkeletonMismatch, naming the joints, if `motion` is not of the representation's hierarchy.
void check_skeleton(const Representation& representation, const Skeleton& skeleton);

}  // namespace strut::representation
