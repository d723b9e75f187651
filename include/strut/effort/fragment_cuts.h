// SPDX-License-Identifier: MIT
// Suggests where a clip falls into units of movement, for a person to look over: from a motion to fragments. Movement
// is cut where it pauses and where it turns back, and what repeats (steps, waves) is cut into whole cycles, there and
// back, always at the same turning point, whatever the pace.
#pragma once

#include <vector>

#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// How a clip is cut. Speeds are compared with the clip's own, so that no body size and no frame rate matters.
struct CutOptions {
  double min_duration = 0.25;  ///< no fragment and no stroke of a cycle is shorter [s], > 0
  double max_duration = 4.0;   ///< longer ones are cut where they are slowest [s], at least 2 min_duration
  double turn_depth = 0.7;     ///< it turns back where it is slower than this share of both neighbouring peaks, (0, 1)
  double pause_speed = 0.08;   ///< it pauses below this share of the clip's fast movement (its 90 % quantile), [0, 1)
  double min_pause = 0.3;      ///< shorter standstills are turning points, not pauses [s], >= 0
};

/// The fragments, in order, disjoint. Speed is the root mean square over the joints, of joint_features.
///
/// Pauses belong to no fragment. Between them the turning points are the minima of speed that stand out by turn_depth;
/// a clip's end counts as one if it is as slow. Where the posture at a turning point returns at the next but one, and
/// that at least three times on end, the unit is the cycle: of its two turning points it begins with that where the
/// left leg is forward, or, if neither leg strides, where the body is wider or higher, whichever differs more. What is
/// left at the clip's ends, cut off in the middle of a movement, belongs to no fragment; nor does what is too short.
///
/// A clip that hardly moves gives none. Throws InvalidArgument if an option is out of range. Cost O(frames x joints).
std::vector<motion::FrameRange> suggest_cuts(const Motion& motion, const CutOptions& options = {});

}  // namespace strut::effort
