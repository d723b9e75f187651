// SPDX-License-Identifier: MIT
// Finds where in a long recording a fragment's movement occurs, at whatever pace: subsequence dynamic time warping with
// slopes between 1/2 and 2 (Sakoe and Chiba 1978, symmetric form, P = 1).
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/motion/annotation.h>

namespace strut::effort {

/// One place where the query occurs.
struct FragmentMatch {
  motion::FrameRange frames;  ///< of the recording
  double cost = 0.0;          ///< mean distance along the path, each step counted once [m]
  double share_at_limit = 0.0;  ///< share of the path that runs at a slope limit, 0 ... 1
};

/// What ends at every frame of the recording.
struct SubsequenceCosts {
  Eigen::VectorXf cost;   ///< of the best match that ends with this frame, mean per step [m]; infinite where none can
  Eigen::VectorXi begin;  ///< that match's first frame
};

/// For every frame of `recording` (n x dims) the best match of the whole `query` (m x dims) that ends there:
///   g(i,j) = min{ g(i-1,j-1) + 2c(i,j), g(i-1,j-2) + 2c(i,j-1) + c(i,j), g(i-2,j-1) + 2c(i-1,j) + c(i,j) }
/// with c the Euclidean distance, g divided by the path's weight (query frames + recording frames covered).
/// Throws InvalidArgument if a matrix is empty, the widths differ or a number is not finite.
/// Cost O(m n dims); several threads over blocks of the recording.
SubsequenceCosts subsequence_costs(const Eigen::Ref<const FrameMatrix>& query,
                                   const Eigen::Ref<const FrameMatrix>& recording);

}  // namespace strut::effort
