// SPDX-License-Identifier: MIT
// How jittery a clip is: jerk, the third derivative of the joints' positions relative to the hips and the heading, and
// pops, single frames that leap out of the movement around them.
#pragma once

#include <strut/metrics/body_track.h>
#include <strut/metrics/curve.h>

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

/// All joints of the track together, where a curve of one joint could be asked for.
inline constexpr int kAllJoints = -1;

/// Jerk over time: the mean over the axes, and the joints if it is kAllJoints, of the absolute third difference [m/s^3]
/// (rows - 3), each at the middle of its four rows. Of a track at the clip's measuring rate, the mean of the curve of
/// all joints is Smoothness::jerk. `joint`: an index in the skeleton. Throws InvalidArgument if the track has fewer
/// than four rows or not this joint (it is above the pelvis). Cost O(rows), of all joints O(rows x joints).
Curve jerk_curve(const BodyTrack& track, int joint = kAllJoints);

/// Speed of a joint relative to the hips and the heading, between the track's rows [m/s] (rows - 1). Throws
/// InvalidArgument if the track has fewer than two rows or not this joint. Cost O(rows).
Curve joint_speed_curve(const BodyTrack& track, int joint);

}  // namespace strut::metrics
