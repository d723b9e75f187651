// SPDX-License-Identifier: MIT
// A measure over time, where it is more than one figure per clip.
#pragma once

#include <Eigen/Core>

namespace strut::metrics {

/// Values at even distances in time; NaN where there is none.
struct Curve {
  double rate = 0.0;       ///< values per second, > 0
  double begin = 0.0;      ///< moment of the first after the clip's first frame [s]
  Eigen::VectorXd values;  ///< in the unit of what is measured
};

/// The curve's values at the frames of a clip: between two of them linearly, half a step beyond one without a neighbour
/// that one, and NaN farther from any. (num_frames)
/// Throws InvalidArgument if a rate is not positive and finite or `num_frames` is negative. Cost O(num_frames).
Eigen::VectorXd at_frames(const Curve& curve, int num_frames, double frame_rate);

}  // namespace strut::metrics
