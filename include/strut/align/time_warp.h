// SPDX-License-Identifier: MIT
// The time-warp stage of iterative motion warping (Hsu et al. 2005, 3.1): how often to repeat each frame of one signal
// so that it comes nearest to another, all degrees of freedom together, the best of all possibilities.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::align {

/// The largest slope limit: its square must fit the byte in which a repetition count is kept.
inline constexpr int kLargestSlopeLimit = 15;

/// Finds the repetition count 1 ... slope_limit^2 of every input frame that minimizes the summed squared distance to
/// the output lengthened `slope_limit` times (every frame repeated), by dynamic programming over the reachable cells.
/// First belongs to first and last to last. Where several are equally good, the one nearest to uniform is taken.
/// `input` (m x dofs), `output` (n x dofs), in one unit per degree of freedom. `weights` (dofs) >= 0 multiply the
/// squared distance of each degree of freedom; empty means 1. Returns m counts that sum to n * slope_limit. Throws
/// InvalidArgument if a size does not fit, a number is not finite, a weight is negative, the slope limit is outside 1
/// ... kLargestSlopeLimit, or the lengths differ by more than the limit (m <= n * limit <= m * limit^2). Cost
/// O(reachable m n (dofs + limit^3)); memory: a byte per reachable cell.
std::vector<int> time_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                           int slope_limit, const Eigen::VectorXd& weights = {});

}  // namespace strut::align
