// SPDX-License-Identifier: MIT
// What fragments are compared by: where the joints are, relative to the body's root and turned so that it always faces
// forward, so that moving or turning a clip on the ground changes nothing, no angle wraps, and no weight of a joint
// has to be invented.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// The rate at which fragments are compared [frames/s].
inline constexpr double kFeatureRate = 30.0;

/// The joints' positions [m] relative to the ground below the pelvis, heading-aligned; x, y, z of each joint from the
/// pelvis down. (frames x 3 joints), at the motion's own rate. `upright`: motion::upright_reference of all clips.
FrameMatrix joint_features(const Motion& motion, const Eigen::Quaterniond& upright);

/// The few directions in which bodies move: principal components of joint_features without any scaling, so that
/// distances in them are distances in metres, less what the left-out components would add.
struct FeatureSpace {
  Eigen::VectorXd mean;        ///< (features)
  Eigen::MatrixXd components;  ///< orthonormal columns, most variance first (features x dimensions)
  double kept = 0.0;           ///< share of the variance that the components keep, 0 ... 1
};

/// Throws InvalidArgument if there is no frame or the clips' widths differ. `max_dimensions` >= 1; fewer where the data
/// has fewer. Cost O(frames x features^2).
FeatureSpace fit_feature_space(const std::vector<FrameMatrix>& clips, int max_dimensions = 24);

/// (frames x dimensions). Throws InvalidArgument if the width does not fit.
FrameMatrix project(const FeatureSpace& space, const Eigen::Ref<const FrameMatrix>& features);

}  // namespace strut::effort
