// SPDX-License-Identifier: MIT
// A fragment as blending reads it: where its pelvis is, how every joint below is turned, and which bones change their
// length, at any moment between its frames, fitted to the skeleton of the blend.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>
#include <strut/representation/relative_root.h>

namespace strut::effort {

/// How lengths of one skeleton become those of another: the ratio of the legs' lengths at rest (without legs: of all
/// bones' lengths together). Exactly 1 for equal skeletons. `from`, `to`: of one hierarchy.
double length_scale(const Motion& from, const Motion& to);

/// A fragment between its frames: rotations and positions are cubics through the frames (Catmull-Rom, rotations as
/// quaternions of unit length).
class BlendSource {
 public:
  /// `skeleton`: the blend's, of the motion's hierarchy; `scale`: length_scale to it. Bones are moved by what they
  /// differ from their skeleton's offset, scaled. Cost O(frames x joints).
  BlendSource(const Motion& motion, const Skeleton& skeleton, double scale);

  /// The moments `frames` [frames]: a row each, to be read by the functions below.
  [[nodiscard]] FrameMatrix sample(const Eigen::VectorXd& frames) const;

  [[nodiscard]] representation::RootTransform pelvis(const FrameMatrix& rows, Eigen::Index row) const;
  /// `joint` counts from 0 below the pelvis.
  [[nodiscard]] Eigen::Quaterniond rotation(const FrameMatrix& rows, Eigen::Index row, int joint) const;
  [[nodiscard]] Eigen::Vector3d translation(const FrameMatrix& rows, Eigen::Index row, int joint) const;

  [[nodiscard]] int num_joints() const noexcept { return num_joints_; }  ///< below the pelvis
  [[nodiscard]] int num_frames() const noexcept { return static_cast<int>(channels_.rows()); }
  /// The largest and smallest translation of a joint, per axis [m].
  [[nodiscard]] Eigen::AlignedBox3d reach_of_bone(int joint) const;

 private:
  int num_joints_;
  FrameMatrix channels_;  // pelvis position, rotation; per joint rotation (x, y, z, w), then per joint translation
};

}  // namespace strut::effort
