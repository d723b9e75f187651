// SPDX-License-Identifier: MIT
// The space-warp stage of iterative motion warping (Hsu et al. 2005, 3.2): the smooth scale a and offset b of every
// degree of freedom that bring the time-warped input nearest to the output.
#pragma once

#include <Eigen/Core>

#include <strut/align/time_warp.h>
#include <strut/math/frame_matrix.h>

namespace strut::align {

/// Beyond it, signals of unit variance would be lost in rounding beside it.
inline constexpr double kLargestSmoothness = 1e12;

/// How stiff the spatial warp is.
struct SpaceWarpOptions {
  double scale_smoothness = 100;   ///< multiplies the sum over frames of (a[t+1] - a[t])^2: F is sqrt(this) times D
  double offset_smoothness = 100;  ///< the same of b, G; in the signals' unit squared, so normalize the signals first
};

/// A spatial warp: frame t of degree of freedom d becomes scale(t, d) * input(t, d) + offset(t, d).
struct SpaceWarp {
  FrameMatrix scale;   ///< a [1] (frames x dofs)
  FrameMatrix offset;  ///< b [the signal's unit] (frames x dofs)

  /// U a + b. (frames x dofs)
  [[nodiscard]] FrameMatrix apply(const Eigen::Ref<const FrameMatrix>& input) const;
};

/// Minimizes |W(Ua + b) - y|^2 + |Fa|^2 + |Gb|^2 over a and b (Equation 4), each degree of freedom by itself. W is
/// `time_warp`: it repeats input frame t over repetitions[t] slots of the output; where it counts frames (open ends), a
/// frame's part of the first term is resolution / repetitions[t] times the sum over its slots. The normal equations are
/// a symmetric positive definite band; interleaved (a, b), they are eliminated in blocks of two. What a constant signal
/// leaves undetermined is settled by a ridge of 1e-8 towards a = 1, b = 0.
/// `input` (m x dofs), `output` (n x dofs), `time_warp` of m and n frames.
/// Throws InvalidArgument if a size does not fit, a count is not positive, a number is not finite or a smoothness is
/// outside 0 ... kLargestSmoothness. Cost O(frames x dofs).
SpaceWarp space_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                     const TimeWarp& time_warp, const SpaceWarpOptions& options = {});

}  // namespace strut::align
