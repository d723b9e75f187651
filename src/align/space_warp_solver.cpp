// SPDX-License-Identifier: MIT
// Equation 4 with the unknowns interleaved (a_0, b_0, a_1, b_1, ...): block tridiagonal with blocks of two. For frame
// t, of weight r (its repetitions, or s where frames count), matched with outputs whose weighted sum is v,
//   diagonal [r u^2 + F_t, r u; r u, r + G_t],   beside it -diag(scale, offset smoothness),   right side [u v; v],
// where F_t, G_t are the smoothness times the number of neighbours. All degrees of freedom are eliminated side by side.
#include "align/space_warp_solver.h"

#include "align/warp_kernels.h"

#include <algorithm>
#include <cstddef>

namespace strut::align::detail {
namespace {

// Small against any signal of unit variance, large enough that a determinant keeps half its digits without one.
constexpr double kRidge = 1e-8;

/// Calls with (output frame, weight) for what one input frame is matched with: its `repetitions` from slot `begin` on.
template <typename Match>
void for_each_match(const TimeWarp& warp, int begin, int repetitions, Match match) {
  const int s = warp.resolution, end = begin + repetitions;
  const double weight = warp.counts_frames ? static_cast<double>(s) / repetitions : 1.0;
  for (int slot = begin; slot < end;) {
    const int j = slot / s, next = std::min(end, (j + 1) * s);
    match(j, weight * (next - slot));
    slot = next;
  }
}

}  // namespace

SpaceWarpSolver::SpaceWarpSolver(const Eigen::Ref<const FrameMatrix>& input,
                                 const Eigen::Ref<const FrameMatrix>& output, const SpaceWarpOptions& options)
    : input_(input),
      output_(output),
      options_(options),
      eliminated_(static_cast<std::size_t>(input.size()) * kEliminated),
      matched_(static_cast<std::size_t>(input.cols())),
      zeros_(static_cast<std::size_t>(input.cols()) * kEliminated, 0.0),
      error_(input.cols()) {}

void SpaceWarpSolver::solve(const TimeWarp& time_warp, SpaceWarp& warp) {
  const WarpKernels& kernels = warp_kernels();
  const Eigen::Index frames = input_.rows(), dofs = input_.cols();
  const auto count = static_cast<int>(dofs);
  const double f = options_.scale_smoothness, g = options_.offset_smoothness;
  warp.scale.resize(frames, dofs);
  warp.offset.resize(frames, dofs);

  // Forward: the inverse of each eliminated block, and a, b as far as the frames before determine them.
  const double *before = zeros_.data(), *before_a = before, *before_b = before;
  int slot = time_warp.begin;
  for (Eigen::Index t = 0; t < frames; ++t) {
    const int repetitions = time_warp.repetitions[static_cast<std::size_t>(t)];
    std::fill(matched_.begin(), matched_.end(), 0.0);
    for_each_match(time_warp, slot, repetitions, [&](int j, double weight) {
      kernels.add_scaled(count, weight, output_.row(j).data(), matched_.data());
    });
    slot += repetitions;
    const int neighbours = (t > 0 ? 1 : 0) + (t + 1 < frames ? 1 : 0);
    const double r = time_warp.counts_frames ? time_warp.resolution : repetitions;
    double* now = eliminated_.data() + t * dofs * kEliminated;
    kernels.eliminate(count, {r, f * neighbours + kRidge, g * neighbours + kRidge, f, g, kRidge}, input_.row(t).data(),
                      matched_.data(), before, before_a, before_b, now, &warp.scale(t, 0), &warp.offset(t, 0));
    before = now;
    before_a = &warp.scale(t, 0);
    before_b = &warp.offset(t, 0);
  }

  // Backward.
  for (Eigen::Index t = frames - 2; t >= 0; --t) {
    kernels.substitute(count, f, g, eliminated_.data() + t * dofs * kEliminated, &warp.scale(t + 1, 0),
                       &warp.offset(t + 1, 0), &warp.scale(t, 0), &warp.offset(t, 0));
  }
}

double SpaceWarpSolver::objective(const TimeWarp& time_warp, const SpaceWarp& warp, const FrameMatrix& p,
                                  const Eigen::VectorXd& weights) {
  const WarpKernels& kernels = warp_kernels();
  const auto count = static_cast<int>(error_.size());
  error_.setZero();
  for (Eigen::Index t = 1; t < warp.scale.rows(); ++t) {
    kernels.add_squared_differences(count, options_.scale_smoothness, &warp.scale(t, 0), &warp.scale(t - 1, 0),
                                    error_.data());
    kernels.add_squared_differences(count, options_.offset_smoothness, &warp.offset(t, 0), &warp.offset(t - 1, 0),
                                    error_.data());
  }
  add_distance(time_warp, p);
  return weighted_error(weights);
}

double SpaceWarpSolver::distance(const TimeWarp& time_warp, const FrameMatrix& p, const Eigen::VectorXd& weights) {
  error_.setZero();
  add_distance(time_warp, p);
  return weighted_error(weights);
}

void SpaceWarpSolver::apply(const SpaceWarp& warp, FrameMatrix& p) const {
  p.resize(warp.scale.rows(), warp.scale.cols());
  for (Eigen::Index t = 0; t < p.rows(); ++t) {
    warp_kernels().warp(static_cast<int>(p.cols()), &warp.scale(t, 0), input_.row(t).data(), &warp.offset(t, 0),
                        &p(t, 0));
  }
}

void SpaceWarpSolver::add_distance(const TimeWarp& time_warp, const FrameMatrix& p) {
  const WarpKernels& kernels = warp_kernels();
  const auto count = static_cast<int>(error_.size());
  int slot = time_warp.begin;
  for (Eigen::Index t = 0; t < p.rows(); ++t) {
    const int repetitions = time_warp.repetitions[static_cast<std::size_t>(t)];
    for_each_match(time_warp, slot, repetitions, [&](int j, double weight) {
      kernels.add_squared_differences(count, weight, &p(t, 0), output_.row(j).data(), error_.data());
    });
    slot += repetitions;
  }
}

double SpaceWarpSolver::weighted_error(const Eigen::VectorXd& weights) const {
  return weights.size() == 0 ? error_.sum() : error_.dot(weights);
}

}  // namespace strut::align::detail
