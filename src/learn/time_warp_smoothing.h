// SPDX-License-Identifier: MIT
// How far a differential time warp is smoothed before it is learnt: as far as makes it predict other recordings.
#pragma once

#include "learn/examples.h"

#include <vector>

#include <Eigen/Core>

namespace strut::learn {

/// The time warp of one pair as alignment gave it.
struct PairWarp {
  const ClipPair* pair = nullptr;
  Eigen::VectorXd differential_warp;  ///< (input frames)
};

/// The reach of smoothing [s], of a few tried, with which warps predict left-out ones best: the warp of every pair is
/// predicted from those of the pairs that share its stretch of input but not its output clip (the mean of their
/// smoothed logarithms, brought to the pair's duration), and judged by how far the moments it maps to are from where
/// the pair's own, unsmoothed, maps them. 0.1 s if no two pairs share a stretch. Cost pairs x frames.
double choose_time_warp_smoothing(const std::vector<PairWarp>& warps, double frame_rate);

}  // namespace strut::learn
