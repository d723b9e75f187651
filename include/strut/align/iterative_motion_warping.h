// SPDX-License-Identifier: MIT
// Iterative motion warping (Hsu et al. 2005, section 3): the correspondence of two motions of the same content in
// different styles. A time warp and a smooth spatial warp are found in turn until neither improves.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/align/space_warp.h>
#include <strut/align/time_warp.h>
#include <strut/math/frame_matrix.h>

namespace strut::align {

/// How two signals are aligned: how their time is warped (slope_limit, resolution, ends, weights), and these. The
/// defaults are the paper's.
struct IterativeMotionWarpingOptions : TimeWarpOptions {
  SpaceWarpOptions space{};  ///< how stiff the spatial warp is
  int max_rounds = 10;       ///< at most this many time and space warps, >= 1
  double tolerance = 1e-6;   ///< stop when a round lowers E by less than this share of it
};

/// What iterative motion warping found.
struct IterativeMotionWarpingResult {
  Correspondence correspondence;  ///< of every input frame; takes multiples of 1/resolution only, see smoothing there
  TimeWarp time_warp;             ///< W of the last round
  SpaceWarp space_warp;           ///< a and b of the last round
  std::vector<double> objective;  ///< E of Equation 1, summed over degrees of freedom, after each round; never rises
  /// False if one of the signals is the same at every frame (in all degrees of freedom that weigh something): nothing
  /// tells its moments apart, and the warp returned is the most even one.
  bool is_determined = true;
};

/// Minimizes E(a, b, W) = |W(Ua + b) - y|^2 + |Fa|^2 + |Gb|^2 from a = 1, b = 0, alternating time_warp and space_warp.
/// With open ends the first term is the one of time_warp, every input frame once; space_warp weighs them alike, so that
/// E never rises there either. Nor does it when the search is coarse to fine: a warp that is worse than the last
/// round's is looked for again, around that one.
/// `input` u (m x dofs) and `output` y (n x dofs) should be normalized (about unit variance), so that the smoothness
/// weighs the same in every degree of freedom. A round that would raise E by rounding is dropped and ends the search.
/// Throws InvalidArgument as time_warp and space_warp do, and if max_rounds or the tolerance is out of range;
/// NumericalError if signals far from unit variance leave no digits of E.
/// Cost: rounds times that of time_warp and space_warp. Memory: that of time_warp, and about 11 m + 3 n frames.
IterativeMotionWarpingResult iterative_motion_warping(const Eigen::Ref<const FrameMatrix>& input,
                                                      const Eigen::Ref<const FrameMatrix>& output,
                                                      const IterativeMotionWarpingOptions& options = {});

}  // namespace strut::align
