// SPDX-License-Identifier: MIT
// One joint over time, as numbers that can be plotted: how it is rotated, where it is.
#pragma once

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>

namespace strut::motion {

/// The rotation vector of `joint` in its parent's frame [rad] (frames x 3), continuous over time as in the encoded
/// pose: of a rotation's vectors the one nearest to the one before, up to 1.5 pi (math::kFarthestAngle), beyond which
/// it begins again at the shortest. Throws InvalidArgument if there is no such joint. Cost O(frames).
FrameMatrix rotation_curve(const Motion& motion, int joint);

/// Where `joint` is in the world [m] (frames x 3). Throws InvalidArgument if there is no such joint.
/// Cost O(frames x joints).
FrameMatrix position_curve(const Motion& motion, int joint);

/// The place of `joint` in its parent's frame [m] (frames x 3). Throws InvalidArgument if there is no such joint.
/// Cost O(frames).
FrameMatrix translation_curve(const Motion& motion, int joint);

/// Whether a joint that hangs on another leaves, in any frame, the place at which the skeleton has it by more than a
/// tenth of a millimetre. False for the root. Throws InvalidArgument if there is no such joint. Cost O(frames).
bool moves_in_parent(const Motion& motion, int joint);

}  // namespace strut::motion
