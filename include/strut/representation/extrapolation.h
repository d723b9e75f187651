// SPDX-License-Identifier: MIT
// What may have come before a clip, so that a model has settled when the clip begins (Hsu et al. 2005, 4.4: "computed
// heuristically using backward extrapolation").
#pragma once

#include <strut/math/frame_matrix.h>

namespace strut::representation {

/// `count` rows that lead up to `rows` (frames x dofs, at least one frame): its beginning reflected through its first
/// frame, so that position and velocity are continuous there. The root's velocities are even in time, all other degrees
/// of freedom odd; beyond the clip's length the reflection of its last frame is held. Result: count x dofs.
/// Throws InvalidArgument if there is no frame or `count` is negative.
FrameMatrix extrapolate_back(const Eigen::Ref<const FrameMatrix>& rows, int count);

}  // namespace strut::representation
