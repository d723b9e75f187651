// SPDX-License-Identifier: MIT
// Signals to align, made from a seed.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::align::test {

/// White noise of unit variance.
inline FrameMatrix noise(int frames, int dofs, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return FrameMatrix::NullaryExpr(frames, dofs, [&] { return normal(generator); });
}

/// Smooth curves of about unit variance: each degree of freedom a few sines of its own.
inline FrameMatrix smooth_curves(int frames, int dofs, unsigned seed) {
  const FrameMatrix random = noise(3 * dofs, 2, seed);
  FrameMatrix curves = FrameMatrix::Zero(frames, dofs);
  for (int t = 0; t < frames; ++t) {
    for (int d = 0; d < dofs; ++d) {
      for (int k = 0; k < 3; ++k) {
        const double frequency = 0.08 * (k + 1) * (1.0 + 0.1 * random(3 * d + k, 1));
        curves(t, d) += 0.8 * std::sin(frequency * t + 3.0 * random(3 * d + k, 0));
      }
    }
  }
  return curves;
}

/// Every frame of `signal` repeated `counts` times.
inline FrameMatrix repeated(const FrameMatrix& signal, const std::vector<int>& counts) {
  int total = 0;
  for (const int count : counts) total += count;
  FrameMatrix result(total, signal.cols());
  Eigen::Index row = 0;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    for (int k = 0; k < counts[t]; ++k) result.row(row++) = signal.row(static_cast<Eigen::Index>(t));
  }
  return result;
}

}  // namespace strut::align::test
