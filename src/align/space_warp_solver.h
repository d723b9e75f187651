// SPDX-License-Identifier: MIT
// The space-warp stage for one pair of signals, for one time warp after another, and the objective that both stages
// lower: what iterative motion warping asks for once a round.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/align/space_warp.h>
#include <strut/align/time_warp.h>
#include <strut/math/aligned.h>
#include <strut/math/frame_matrix.h>

namespace strut::align::detail {

/// Throws InvalidArgument unless both are 0 ... kLargestSmoothness.
void check_space_warp(const SpaceWarpOptions& options);

/// Signals and time warps are checked by the caller, and outlive it.
class SpaceWarpSolver {
 public:
  SpaceWarpSolver(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                  const SpaceWarpOptions& options);
  /// The best a and b (space_warp.h).
  void solve(const TimeWarp& time_warp, SpaceWarp& warp);
  /// Equation 1, summed over the degrees of freedom times their weights, of which there may be none; p = U a + b.
  double objective(const TimeWarp& time_warp, const SpaceWarp& warp, const FrameMatrix& p,
                   const Eigen::VectorXd& weights);
  /// Its first term alone: what the time-warp stage lowers.
  double distance(const TimeWarp& time_warp, const FrameMatrix& p, const Eigen::VectorXd& weights);
  /// p = U a + b.
  void apply(const SpaceWarp& warp, FrameMatrix& p) const;

 private:
  void add_distance(const TimeWarp& time_warp, const FrameMatrix& p);
  [[nodiscard]] double weighted_error(const Eigen::VectorXd& weights) const;

  Eigen::Ref<const FrameMatrix> input_, output_;
  SpaceWarpOptions options_;
  math::AlignedVector<double> eliminated_;  // of every frame
  math::AlignedVector<double> matched_;     // W' y of one
  math::AlignedVector<double> zeros_;
  Eigen::VectorXd error_;  // by degree of freedom
};

}  // namespace strut::align::detail
