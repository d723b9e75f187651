// SPDX-License-Identifier: MIT
// Motions at other times: between frames, rotations are interpolated along the shorter arc (slerp), translations
// linearly.
#pragma once

#include <vector>

#include <strut/motion/motion.h>

namespace strut::motion {

/// The pose between `a` (weight 0) and `b` (weight 1); weights outside [0, 1] extrapolate.
Pose interpolate(const Pose& a, const Pose& b, double weight);

/// The pose at `time` [s] after the first frame; times outside the motion give its first or last frame.
/// Throws InvalidArgument if the motion is empty or `time` is not finite.
Pose sample(const Motion& motion, double time);

/// The motion at another frame rate [frames/s]. The first frame stays; the last lies at or before the source's last.
/// Throws InvalidArgument if the rate is not positive and finite. Cost O(output frames x joints).
Motion resample(const Motion& motion, double frame_rate);

}  // namespace strut::motion
