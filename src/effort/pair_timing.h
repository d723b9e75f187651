// SPDX-License-Identifier: MIT
// When two fragments do the same, and when a blend of them does it: two curves over a common time u that treat both
// fragments alike, and the time of a blend as a third.
#pragma once

#include <vector>

#include <strut/math/smooth_curve.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// Knots of strictly rising curves over u from 0 to 1. At u = 0 both fragments begin, at u = 1 both end.
struct PairTiming {
  std::vector<double> u;
  std::vector<double> first;   ///< p(u), from 0 to the first fragment's last frame [frames]
  std::vector<double> second;  ///< q(u), alike
  double least_alpha = 0.0;    ///< in [least_alpha, greatest_alpha] a blend's time is linear in alpha
  double greatest_alpha = 1.0;
};

/// Aligns both ways round (align::refine_warp of timing_features), takes the mean of the two curves, so that
/// swapping the fragments swaps p and q, and smooths it. q' / p' stays inside 1 / slope_limit ... slope_limit.
/// Throws InvalidArgument if the durations differ by more than that. Cost: two alignments.
PairTiming align_fragments(const Motion& first, const Motion& second, double slope_limit);

/// t(u): when a blend is at u [frames]. From least_alpha to greatest_alpha (1 - alpha) p + alpha q; beyond, every rate
/// changes by q' / p' per unit of alpha from what it is there. Continuous in alpha, and always rises. Cost O(knots).
math::SmoothCurve blended_time(const PairTiming& timing, double alpha);

}  // namespace strut::effort
