// SPDX-License-Identifier: MIT
// Signals between their frames.
#pragma once

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::math {

/// The rows of `signal` (frames x dofs) at fractional row numbers `positions` (count), by Catmull-Rom cubics: exact at
/// the rows, first derivative continuous, straight lines kept. Positions beyond the ends give the first or last row.
/// Throws InvalidArgument if the signal has no row or a position is not finite. Result: count x dofs. Cost O(count x
/// dofs).
FrameMatrix sample_rows(const Eigen::Ref<const FrameMatrix>& signal,
                        const Eigen::Ref<const Eigen::VectorXd>& positions);

}  // namespace strut::math
