// SPDX-License-Identifier: MIT
// The one-pole low-pass filter that everything smoothed over time is smoothed with: y += gain (x - y), once a frame.
#pragma once

#include <cmath>

namespace strut::math {

/// The gain of a filter with a time constant of `frames`: its answer to a step has 1/e left to go after that many. 1,
/// no smoothing, where `frames` is not above 0.
inline double low_pass_gain(double frames) {
  return frames > 0.0 ? 1.0 - std::exp(-1.0 / frames) : 1.0;
}

}  // namespace strut::math
