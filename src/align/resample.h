// SPDX-License-Identifier: MIT
// Coarser copies of signals, and paths carried from them to finer ones: for searches coarse to fine.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::align::detail {

/// The same time in fewer frames: each the mean over what it covers. 1 <= frames <= signal frames.
FrameMatrix resampled(const FrameMatrix& signal, Eigen::Index frames);

/// A path (places in 0 ... slots after 0 ... frames input frames) as one of `frames` input frames and `slots` slots.
std::vector<int> stretched(const std::vector<int>& path, int path_slots, int frames, int slots);

}  // namespace strut::align::detail
