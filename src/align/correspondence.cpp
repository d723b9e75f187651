// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/align/correspondence.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

// Warps are sums of up to thousands of fractions; two that differ by less are the same.
constexpr double kRounding = 1e-9;

// How near the slope limit counts as at it.
constexpr double kNearLimit = 0.05;

}  // namespace

Eigen::VectorXd Correspondence::output_time() const {
  const double last = output_end() + output_rest - 1.0;
  Eigen::VectorXd time(differential_warp.size());
  double passed = output_begin;
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const double w = differential_warp[i];
    time[i] = std::max(0.0, std::min(passed + 0.5 * w - 0.5, last));
    passed += w;
  }
  return time;
}

Correspondence from_repetitions(const std::vector<int>& repetitions, int resolution) {
  if (resolution < 1) throw InvalidArgument("resolution", "at least 1", std::to_string(resolution));
  const auto size = static_cast<Eigen::Index>(repetitions.size());
  return {Eigen::Map<const Eigen::VectorXi>(repetitions.data(), size).cast<double>() / resolution};
}

Eigen::VectorXd smooth_differential_warp(const Eigen::Ref<const Eigen::VectorXd>& w, double smoothness) {
  if (!(smoothness >= 0.0) || !std::isfinite(smoothness)) {
    throw InvalidArgument("smoothness", "a number that is not negative", std::to_string(smoothness));
  }
  if (!w.allFinite()) throw InvalidArgument("w", "finite numbers", "NaN or infinity");
  // (I + smoothness D'D) v = w. The inverse has no negative entry, and rows and columns that sum to one: hence the
  // bounds and the kept sum. Tridiagonal elimination.
  const Eigen::Index n = w.size();
  Eigen::VectorXd v = w, pivot(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int neighbours = (i > 0 ? 1 : 0) + (i + 1 < n ? 1 : 0);
    pivot[i] = 1.0 + smoothness * neighbours;
    if (i == 0) continue;
    pivot[i] -= smoothness * smoothness / pivot[i - 1];
    v[i] += smoothness / pivot[i - 1] * v[i - 1];
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) v[i] = (v[i] + (i + 1 < n ? smoothness * v[i + 1] : 0.0)) / pivot[i];
  return v;
}

double share_at_slope_limit(const Eigen::Ref<const Eigen::VectorXd>& w, double slope_limit) {
  if (w.size() == 0) return 0.0;
  const auto at_limit = w.array() >= (1.0 - kNearLimit) * slope_limit || w.array() * slope_limit <= 1.0 + kNearLimit;
  return static_cast<double>(at_limit.count()) / static_cast<double>(w.size());
}

FrameMatrix warp_to_input(const Eigen::Ref<const FrameMatrix>& output, const Correspondence& correspondence) {
  const double frames = correspondence.output_end() + correspondence.output_rest;
  if (!(correspondence.output_begin >= 0.0) || !(correspondence.output_rest >= 0.0)) {
    throw InvalidArgument("correspondence", "ends within the output", "ends beyond it");
  }
  if (!(std::abs(frames - static_cast<double>(output.rows())) <= kRounding * (1.0 + frames))) {
    throw InvalidArgument("output", std::to_string(frames) + " frames, as the correspondence covers",
                          std::to_string(output.rows()));
  }
  const Eigen::VectorXd time = correspondence.output_time();
  FrameMatrix warped(time.size(), output.cols());
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const auto before = static_cast<Eigen::Index>(time[i]);
    const Eigen::Index after = std::min(before + 1, output.rows() - 1);
    const double weight = time[i] - static_cast<double>(before);
    warped.row(i) = (1.0 - weight) * output.row(before) + weight * output.row(after);
  }
  return warped;
}

}  // namespace strut::align
