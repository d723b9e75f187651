// SPDX-License-Identifier: MIT
// How fast feet move over the ground while they ought to stand: near zero in a recording, tens of centimetres per
// second in motion whose feet skate.
#pragma once

#include <vector>

#include <strut/metrics/body_track.h>
#include <strut/metrics/curve.h>
#include <strut/motion/annotation.h>

namespace strut::metrics {

/// A slide and the foot and moment at which it is worst.
struct FootSlide {
  double speed = 0.0;        ///< over the ground, where feet ought to stand [m/s]
  double worst_speed = 0.0;  ///< in the worst second or plant [m/s]
  Place worst;               ///< the foot (its toe joint) and the middle of that stretch
};

/// Slide without knowing when feet are planted: the median, over both feet and every whole second, of the slowest
/// 0.15 s of that second. A standing or walking body plants each foot once a second or more often.
/// Throws InvalidArgument for fewer than two frames. Cost O(frames).
FootSlide foot_slide(const BodyTrack& track);

/// Slide while planted: the mean over all planted frames of the speed of the foot's slower end, ankle or toe, so that
/// rolling over heel or toe is no slide. `plants` in the frames of the clip that the track was made from, foot 0 =
/// left, 1 = right; speed 0 and joint -1 if none covers two frames of the track. Throws InvalidArgument if a plant
/// names another foot or lies outside the clip. Cost O(frames).
FootSlide foot_slide(const BodyTrack& track, const std::vector<motion::Footplant>& plants);

/// The slide of one foot while planted, over time: the speed over the ground of its slower end between the track's rows
/// [m/s] (rows - 1), NaN where the foot is not planted. Over both feet the mean of what there is is foot_slide's speed,
/// if the plants of a foot do not overlap. `foot` and `plants` as above; throws alike, and for fewer than two rows.
/// Cost O(frames).
Curve foot_slide_curve(const BodyTrack& track, const std::vector<motion::Footplant>& plants, int foot);

/// The height of the foot's lower end, ankle or toe, above the ground (y = 0) at each of the track's rows [m]. Throws
/// InvalidArgument if `foot` is neither 0 (left) nor 1 (right). Cost O(frames).
Curve foot_height_curve(const BodyTrack& track, int foot);

}  // namespace strut::metrics
