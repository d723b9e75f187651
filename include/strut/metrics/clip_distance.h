// SPDX-License-Identifier: MIT
// How far one clip's movement is from another's, whatever its place, heading and timing. Every second of one clip looks
// for its best match anywhere in the other by dynamic time warping with slopes between 1/2 and 2; what is compared are
// joint positions relative to the hips and the heading. Two takes of one style are a few centimetres apart.
#pragma once

#include <strut/metrics/body_track.h>

namespace strut::metrics {

/// The stretch of one clip that found the worst best match in the other.
struct WorstMatch {
  bool in_first = true;         ///< whether it is a stretch of the first clip (sought in the second)
  double distance = 0.0;        ///< mean over the stretch and the joints [m]
  Place begin;                  ///< its first frame, and the joint that lies farthest from its match
  Place match_begin;            ///< first frame of the best match in the other clip, and the same joint
  double joint_distance = 0.0;  ///< of that joint, mean over the stretch [m]
};

/// A distance between two clips and where they differ most.
struct ClipDistance {
  double distance = 0.0;         ///< mean of the two below [m]
  double first_in_second = 0.0;  ///< mean over the windows of the first clip [m]
  double second_in_first = 0.0;  ///< mean over the windows of the second clip [m]
  WorstMatch worst;
};

/// Distance between two clips: windows of one second every half second, each matched by subsequence dynamic time
/// warping (steps of 1:1, 1:2 and 2:1 frames; Sakoe and Chiba 1978, slope condition P = 1), the mean joint distance
/// along the path, the mean over windows and over both directions. A clip much shorter than the other is matched in
/// shorter windows. Symmetric; zero for a clip and itself, moved and turned on the ground. Throws SkeletonMismatch if
/// names or hierarchy differ, InvalidArgument if the rates do. Cost O(frames x frames x joints), about a millisecond
/// for two clips of ten seconds.
ClipDistance clip_distance(const BodyTrack& first, const BodyTrack& second);

/// The same from motions of any rate, both brought to kComparisonRate.
ClipDistance clip_distance(const Motion& first, const Motion& second);

}  // namespace strut::metrics
