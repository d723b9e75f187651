// SPDX-License-Identifier: MIT
// How jittery a clip is: jerk, the third derivative of the joints' positions relative to the hips and the heading, and
// pops, single frames that leap out of the movement around them.
#pragma once

#include <strut/metrics/body_track.h>

namespace strut::metrics {

/// Jerk and pops, with the worst of each.
struct Smoothness {
  double jerk = 0.0;        ///< mean over frames, joints and axes of the absolute third difference [m/s^3]
  double worst_jerk = 0.0;  ///< largest, as a vector's length [m/s^3]
  Place worst;              ///< where that is
  double pop = 0.0;         ///< largest distance of a joint from halfway between its neighbour frames' places [m]
  Place worst_pop;          ///< where that is
};

/// Jerk at the clip's measuring rate (jerk grows with the rate, so clips are measured near the same one), pops at the
/// clip's own rate (a bad frame must not be skipped).
/// Throws InvalidArgument if the motion has fewer than four frames at either rate, or no legs. Cost O(frames x joints).
Smoothness smoothness(const Motion& motion);

}  // namespace strut::metrics
