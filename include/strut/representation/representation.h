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

/// Frame by frame from poses to rows. Holds what the previous frame leaves behind: place, heading, and each rotation
/// vector (to stay on the same branch).
class Encoder {
 public:
  Encoder(const Representation& representation, double frame_rate);
  /// Writes one row (num_dofs). On the first frame the velocities are zero. No allocation.
  void encode(const Pose& pose, Eigen::Ref<Eigen::RowVectorXd> row);
  /// Where the latest frame stood.
  [[nodiscard]] const RootPlacement& placement() const noexcept { return placement_; }

 private:
  const Representation* representation_;
  double frame_time_;
  bool started_ = false;
  RootPlacement placement_;
  std::vector<Eigen::Vector3d> previous_;
};

/// Frame by frame from rows to poses: the inverse of Encoder.
class Decoder {
 public:
  /// The first frame stands at `start`; its velocities are ignored.
  Decoder(const Representation& representation, double frame_rate, const RootPlacement& start);
  /// Writes one pose with the bones (translations) of `bones`. Allocates only if `pose` has another size.
  void decode(const Eigen::Ref<const Eigen::RowVectorXd>& row, const Pose& bones, Pose& pose);

 private:
  const Representation* representation_;
  double frame_time_;
  bool started_ = false;
  RootPlacement placement_;
};

/// A whole motion as rows: frames x num_dofs. The first row has the second's velocities.
/// Throws SkeletonMismatch if the hierarchy differs from the representation's.
FrameMatrix encode(const Representation& representation, const Motion& motion);

/// Rows (frames x num_dofs) as a motion that starts at `start`, with the bones of `bones` on `skeleton`.
/// encode then decode is the identity up to rounding. Throws InvalidArgument if the width is not num_dofs.
Motion decode(const Representation& representation, const Eigen::Ref<const FrameMatrix>& rows, double frame_rate,
              const RootPlacement& start, const std::shared_ptr<const Skeleton>& skeleton, const Pose& bones);

/// Throws SkeletonMismatch, naming the joints, if `motion` is not of the representation's hierarchy.
void check_skeleton(const Representation& representation, const Skeleton& skeleton);

}  // namespace strut::representation
