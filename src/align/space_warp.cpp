// SPDX-License-Identifier: MIT
// Equation 4 with the unknowns interleaved (a_0, b_0, a_1, b_1, ...): block tridiagonal with blocks of two. For frame
// t, repeated r times against outputs that sum to v,
//   diagonal [r u^2 + F_t, r u; r u, r + G_t],   beside it -diag(scale, offset smoothness),   right side [u v; v],
// where F_t, G_t are the smoothness times the number of neighbours. All degrees of freedom are eliminated side by side.
#include "align/signals.h"

#include <cmath>
#include <numeric>
#include <string>

#include <strut/align/space_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

using Row = Eigen::Array<double, 1, Eigen::Dynamic>;

// Small against any signal of unit variance, large enough that a determinant keeps half its digits without one.
constexpr double kRidge = 1e-8;

void check_options(const SpaceWarpOptions& options) {
  for (const double smoothness : {options.scale_smoothness, options.offset_smoothness}) {
    if (!(smoothness >= 0.0) || !std::isfinite(smoothness)) {
      throw InvalidArgument("smoothness", "a number that is not negative", std::to_string(smoothness));
    }
  }
}

void check_repetitions(const std::vector<int>& repetitions, Eigen::Index input_frames, Eigen::Index slots) {
  const auto size = static_cast<Eigen::Index>(repetitions.size());
  const long sum = std::accumulate(repetitions.begin(), repetitions.end(), 0L);
  bool positive = true;
  for (const int r : repetitions) positive = positive && r > 0;
  if (size == input_frames && sum == slots && positive) return;
  throw InvalidArgument("repetitions",
                        std::to_string(input_frames) + " positive counts that sum to " + std::to_string(slots),
                        std::to_string(size) + " counts that sum to " + std::to_string(sum));
}

/// W' y: the outputs each input frame is repeated against, summed.
FrameMatrix sum_of_matched(const Eigen::Ref<const FrameMatrix>& output, const std::vector<int>& repetitions, int s) {
  FrameMatrix sums = FrameMatrix::Zero(static_cast<Eigen::Index>(repetitions.size()), output.cols());
  int slot = 0;
  for (Eigen::Index t = 0; t < sums.rows(); ++t) {
    const int end = slot + repetitions[static_cast<std::size_t>(t)];
    for (; slot < end; ++slot) sums.row(t) += output.row(slot / s);
  }
  return sums;
}

}  // namespace

FrameMatrix SpaceWarp::apply(const Eigen::Ref<const FrameMatrix>& input) const {
  return scale.cwiseProduct(input) + offset;
}

SpaceWarp space_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                     const std::vector<int>& repetitions, int slope_limit, const SpaceWarpOptions& options) {
  detail::check_signals(input, output);
  check_options(options);
  check_repetitions(repetitions, input.rows(), output.rows() * slope_limit);
  const Eigen::Index frames = input.rows(), dofs = input.cols();
  const double f = options.scale_smoothness, g = options.offset_smoothness;
  const FrameMatrix matched = sum_of_matched(output, repetitions, slope_limit);

  // Forward: the inverse of each eliminated block, and a, b as far as the frames before determine them.
  FrameMatrix inverse_aa(frames, dofs), inverse_ab(frames, dofs), inverse_bb(frames, dofs);
  SpaceWarp warp{FrameMatrix(frames, dofs), FrameMatrix(frames, dofs)};
  Row aa(dofs), ab(dofs), bb(dofs), right_a(dofs), right_b(dofs), determinant(dofs);
  for (Eigen::Index t = 0; t < frames; ++t) {
    const auto u = input.row(t).array();
    const double r = repetitions[static_cast<std::size_t>(t)];
    const int neighbours = (t > 0 ? 1 : 0) + (t + 1 < frames ? 1 : 0);
    aa = r * u.square() + (f * neighbours + kRidge);
    ab = r * u;
    bb.setConstant(r + g * neighbours + kRidge);
    right_a = u * matched.row(t).array() + kRidge;
    right_b = matched.row(t).array();
    if (t > 0) {
      aa -= f * f * inverse_aa.row(t - 1).array();
      ab -= f * g * inverse_ab.row(t - 1).array();
      bb -= g * g * inverse_bb.row(t - 1).array();
      right_a += f * warp.scale.row(t - 1).array();
      right_b += g * warp.offset.row(t - 1).array();
    }
    determinant = (aa * bb - ab.square()).inverse();
    inverse_aa.row(t) = bb * determinant;
    inverse_ab.row(t) = -ab * determinant;
    inverse_bb.row(t) = aa * determinant;
    warp.scale.row(t) = inverse_aa.row(t).array() * right_a + inverse_ab.row(t).array() * right_b;
    warp.offset.row(t) = inverse_ab.row(t).array() * right_a + inverse_bb.row(t).array() * right_b;
  }

  // Backward.
  for (Eigen::Index t = frames - 2; t >= 0; --t) {
    right_a = f * warp.scale.row(t + 1).array();
    right_b = g * warp.offset.row(t + 1).array();
    warp.scale.row(t).array() += inverse_aa.row(t).array() * right_a + inverse_ab.row(t).array() * right_b;
    warp.offset.row(t).array() += inverse_ab.row(t).array() * right_a + inverse_bb.row(t).array() * right_b;
  }
  return warp;
}

}  // namespace strut::align
