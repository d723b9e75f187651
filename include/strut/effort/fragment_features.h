// SPDX-License-Identifier: MIT
// What fragments are compared by: where the joints are, relative to the body's root and turned so that it always faces
// forward, so that moving or turning a clip on the ground changes nothing, no angle wraps, and no weight of a joint
// has to be invented.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// The rate at which fragments are compared [frames/s].
inline constexpr double kFeatureRate = 30.0;

/// The joints that are compared: the pelvis and everything below it, ascending. What carries the pelvis about does not
/// count, for where it stands says nothing about posture.
std::vector<int> feature_joints(const Skeleton& skeleton);

/// Positions [m] of the feature_joints relative to the ground below the pelvis, with the way the body faces turned to
/// +Z: x, y, z of each joint, so that heights stay heights above the ground (frames x 3 joints), at the motion's own
/// rate. `upright`: motion::upright_reference of all clips that are compared, one for all of them. Throws
/// InvalidArgument if `upright` is not of unit length. Cost O(frames x joints).
FrameMatrix joint_features(const Motion& motion, const Eigen::Quaterniond& upright);

/// The few directions in which bodies move: principal components of joint_features without any scaling, so that
/// distances in them are distances in metres, less what the left-out components would add.
struct FeatureSpace {
  Eigen::VectorXd mean;        ///< (features)
  Eigen::MatrixXd components;  ///< orthonormal columns, most variance first (features x dimensions)
  double kept = 0.0;           ///< share of the variance that the components keep, 0 ... 1
};

/// Fits the space to all frames of all clips (each frames x features). At most `max_dimensions` >= 1 of them, fewer
/// where the data has fewer, at least one. Throws InvalidArgument if there is no frame, the clips' widths differ, a
/// number is not finite or max_dimensions is below 1. Cost O(frames x features^2).
FeatureSpace fit_feature_space(const std::vector<FrameMatrix>& clips, int max_dimensions = 24);

/// The features' coordinates in the space (frames x dimensions). The distance of two rows is at most that of their
/// features. Throws InvalidArgument if the width does not fit. Cost O(frames x features x dimensions).
FrameMatrix project(const FeatureSpace& space, const Eigen::Ref<const FrameMatrix>& features);

}  // namespace strut::effort
