// SPDX-License-Identifier: MIT
// Iterative motion warping (Hsu et al. 2005, section 3): the correspondence of two motions of the same content in
// different styles. A time warp and a smooth spatial warp are found in turn until neither improves.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/align/space_warp.h>
#include <strut/math/frame_matrix.h>

namespace strut::align {

/// How two signals are aligned. The defaults are the paper's.
struct IterativeMotionWarpingOptions {
  int slope_limit = 2;        ///< an input frame covers 1/limit ... limit output frames
  SpaceWarpOptions space;     ///< how stiff the spatial warp is
  int max_rounds = 10;        ///< at most this many time and space warps, >= 1
  double tolerance = 1e-6;    ///< stop when a round lowers E by less than this share of it
  Eigen::VectorXd weights{};  ///< multiplies each degree of freedom's part of E, >= 0; empty means 1 (dofs)
};

/// What iterative motion warping found.
struct IterativeMotionWarpingResult {
  Correspondence correspondence;  ///< of every input frame; takes multiples of 1/slope_limit only, see smoothing there
  std::vector<int> repetitions;   ///< 1 ... slope_limit^2 per input frame, sums to output frames * slope_limit
  SpaceWarp space_warp;           ///< a and b of the last round
  std::vector<double> objective;  ///< E of Equation 1, summed over degrees of freedom, after each round; never rises
};

/// Minimizes E(a, b, W) = |W(Ua + b) - y|^2 + |Fa|^2 + |Gb|^2 from a = 1, b = 0, alternating time_warp and space_warp.
/// `input` u (m x dofs) and `output` y (n x dofs) should be normalized (about unit variance), so that the smoothness
/// weighs the same in every degree of freedom. A round that would raise E by rounding is dropped and ends the search.
/// Throws InvalidArgument as time_warp and space_warp do, and if max_rounds or the tolerance is out of range.
/// Cost: rounds times that of time_warp and space_warp.
IterativeMotionWarpingResult iterative_motion_warping(const Eigen::Ref<const FrameMatrix>& input,
                                                      const Eigen::Ref<const FrameMatrix>& output,
                                                      const IterativeMotionWarpingOptions& options = {});

}  // namespace strut::align
