// SPDX-License-Identifier: MIT
// How a body gets along: steps per second and the speed of its hips over the ground.
#pragma once

#include <strut/metrics/body_track.h>
#include <strut/metrics/curve.h>

namespace strut::metrics {

/// Steps and speed, with the longest step and the fastest moment. All zero steps and speed for a body that stays put.
struct Gait {
  double travel = 0.0;        ///< length of the hips' path over the ground [m]
  double speed = 0.0;         ///< distance between the path's ends over the duration [m/s]
  double cadence = 0.0;       ///< steps per second: how often the other foot comes to lead
  double longest_step = 0.0;  ///< longest time from one foot's lead to the other's [s]; 0 with fewer than two changes
  Place longest_step_begin;   ///< where it begins, and the ankle that comes to lead there
  double top_speed = 0.0;     ///< highest speed of the hips over any 0.15 s [m/s]
  Place fastest;              ///< the middle of that stretch
};

/// Reads the gait off a track. A foot comes to lead when it is ahead of the other, along the heading, by 30 % of the
/// farthest it ever is (both feet's, smoothed over a sixth of a second), so that shuffling on the spot is no step.
/// Speed and cadence are 0 where the hips travel less than half a metre. Throws InvalidArgument for fewer than two
/// frames. Cost O(frames).
Gait gait(const BodyTrack& track);

/// Speed of the hips over the ground at each of the track's rows [m/s]: central differences, one-sided at the ends.
/// Throws InvalidArgument for fewer than two frames. Cost O(frames).
Curve ground_speed_curve(const BodyTrack& track);

/// How fast the heading turns at each of the track's rows, to the body's left positive [rad/s]; differences and errors
/// as above.
Curve turn_rate_curve(const BodyTrack& track);

}  // namespace strut::metrics
