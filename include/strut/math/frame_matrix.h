// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace strut {

/// Signals over time: a row per frame, a column per degree of freedom. Row-major, so that a row passes as a vector and
/// a NumPy array passes without a copy.
using FrameMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace strut
