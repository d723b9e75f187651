// SPDX-License-Identifier: MIT
// A time warp that is a smooth curve. Dynamic programming counts whole slots, so its warps stand still and jump; here
// the same disagreement of two signals is lowered over warps of any slope, between frames too, by Gauss-Newton steps
// from where dynamic programming ended. Beyond Hsu et al. 2005; the paper's form is iterative_motion_warping.h.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/align/space_warp.h>
#include <strut/math/frame_matrix.h>

namespace strut::align {

/// What a smooth warp may do. Reaches are times, so that a recording at another frame rate is warped alike.
struct ContinuousWarpOptions {
  double slope_limit = 3.0;    ///< L > 1: slopes stay inside 1/L ... L
  double slope_reach = 0.003;  ///< how stiff the time warp is [s], >= 0: over about this time its slope may change
  double space_reach = 0.5;    ///< how stiff scale and offset are [s], >= 0
  int max_rounds = 8;          ///< of space warps, each with a few steps of the time warp, >= 1
  double tolerance = 1e-4;     ///< stop when a round lowers the objective by less than this share of it, >= 0
  Eigen::VectorXd weights{};   ///< of the degrees of freedom, >= 0; only their ratios matter; empty: equal (dofs)
};

/// A smooth warp.
struct ContinuousWarp {
  Correspondence correspondence;  ///< of every input frame; slopes strictly inside the limit
  SpaceWarp space_warp;           ///< a and b of the last round
  std::vector<double> objective;  ///< E below, after every accepted step; never rises
};

/// Lowers, from `start` on,
///   E(a, b, T) = mean over dofs of sum over t of (a u + b - y(tau))^2 + (space_reach rate)^2 (|Da|^2 + |Db|^2)
///                + (slope_reach rate)^2 |D log w|^2 + a barrier that keeps every w inside the slope limit,
/// where u is the input, y the output between its frames (Catmull-Rom), T_t where input frame t begins in the output,
/// w_t = T_{t+1} - T_t and tau_t = (T_t + T_{t+1}) / 2. In turn a and b are solved for (space_warp) and T is stepped
/// (Gauss-Newton, a band of five diagonals); a step that does not lower E is shortened, then dropped. The ends stay.
/// `input` (m x dofs), `output` (n x dofs), normalized as for iterative_motion_warping, at `frame_rate` [frames/s];
/// `start`: of any method, smoothed first if it counts slots (smooth_differential_warp); slopes outside the limit are
/// drawn inside. Throws InvalidArgument if a size does not fit, a number is not finite, a weight is negative or all are
/// zero, an option is out of range, or the lengths differ by more than the limit. Cost O(rounds (m + n) dofs).
ContinuousWarp refine_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                           const Correspondence& start, double frame_rate, const ContinuousWarpOptions& options = {});

/// refine_warp from the time-warp stage of iterative motion warping (time_warp.h), smoothed over 0.1 s.
/// Throws as both. Cost: one time_warp and a refine_warp.
ContinuousWarp continuous_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                               double frame_rate, const ContinuousWarpOptions& options = {});

}  // namespace strut::align
