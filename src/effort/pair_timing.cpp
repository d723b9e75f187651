// SPDX-License-Identifier: MIT
// Symbols of the design: p, q the frames of the two fragments, s the slope limit. Both fragments are laid along [0, 1];
// a curve y(x) of one over the other is written as its height v = y - x above the diagonal over u = (x + y) / 2, in
// which a mean of two curves is a mean of heights and keeps their slopes.
#include "effort/pair_timing.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <strut/align/continuous_warp.h>
#include <strut/align/time_warp.h>
#include <strut/core/error.h>
#include <strut/representation/alignment_features.h>

namespace strut::effort {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Over how long a warp of counts is smoothed, and the curves of the answer [s].
constexpr double kCountSmoothing = 0.1;
constexpr double kSmoothing = 0.2;
// No rate of a blend that is linear in alpha is less than this share of the nearer fragment's.
constexpr double kLeastRate = 0.1;
// Durations whose ratio exceeds the slope limit by less than this share have it.
constexpr double kRounding = 1e-9;

void check_durations(int first, int second, double limit) {
  const double ratio = (second - 1.0) / (first - 1.0);
  if (std::max(ratio, 1.0 / ratio) <= limit * (1.0 + kRounding)) return;
  const std::string times = std::to_string(limit).substr(0, 4);
  throw InvalidArgument("second", "a fragment at most " + times + " times as long as the first, or as short",
                        std::to_string(second) + " frames against " + std::to_string(first),
                        "trim the longer one, or allow a larger slope limit");
}

/// dv/du, the mean over each of `count` equal steps of u, of a warp that covers 1/m of x with every entry.
VectorXd height_changes(const VectorXd& warp, Index count) {
  const auto m = static_cast<double>(warp.size());
  const VectorXd steps = warp / warp.sum();
  std::vector<double> u{0.0}, v{0.0};
  for (Index t = 0; t < warp.size(); ++t) {
    u.push_back(u.back() + 0.5 * (1.0 / m + steps[t]));
    v.push_back(v.back() + steps[t] - 1.0 / m);
  }
  VectorXd heights(count + 1);
  std::size_t i = 0;
  for (Index k = 0; k <= count; ++k) {
    const double at = static_cast<double>(k) / static_cast<double>(count);
    while (i + 2 < u.size() && u[i + 1] < at) ++i;
    const double share = std::clamp((at - u[i]) / (u[i + 1] - u[i]), 0.0, 1.0);
    heights[k] = v[i] + share * (v[i + 1] - v[i]);
  }
  return (heights.tail(count) - heights.head(count)) * static_cast<double>(count);
}

/// As align::continuous_warp, but for limits that are no whole numbers too where durations come near them: the start is
/// searched with a whole limit, at which counts reach it, and drawn inside.
VectorXd found_warp(const FrameMatrix& input, const FrameMatrix& output, const VectorXd& weights, double frame_rate,
                    double slope_limit) {
  align::TimeWarpOptions counts;
  counts.slope_limit = std::max(2.0, std::ceil(slope_limit));
  counts.weights = weights;
  const VectorXd counted = align::time_warp(input, output, counts).correspondence().differential_warp;
  const double frames = kCountSmoothing * frame_rate;
  align::ContinuousWarpOptions options;
  options.slope_limit = slope_limit;
  options.weights = weights;
  const align::Correspondence start{align::smooth_differential_warp(counted, frames * frames)};
  return align::refine_warp(input, output, start, frame_rate, options).correspondence.differential_warp;
}

/// `changes` drawn to zero, their mean, until the ratio q' / p' is inside the limit; `ratio`: of the durations.
void draw_inside(VectorXd& changes, double ratio, double limit) {
  const auto change_at = [ratio](double slope) { return 2.0 * (slope - ratio) / (slope + ratio); };
  changes.array() -= changes.mean();
  double share = 1.0;
  for (const double change : changes) {
    const double room = change_at(change > 0.0 ? limit : 1.0 / limit);
    if (std::abs(change) > std::abs(room)) share = std::min(share, std::abs(room / change));
  }
  changes *= share;
}

/// The curves whose heights change by `changes`, and where a blend's time may be linear.
PairTiming curves_of(const VectorXd& changes, double first_last, double second_last, double limit) {
  const Index count = changes.size();
  PairTiming timing;
  double height = 0.0;
  for (Index k = 0; k <= count; ++k) {
    const double u = static_cast<double>(k) / static_cast<double>(count);
    timing.u.push_back(u);
    timing.first.push_back(first_last * (u - 0.5 * height));
    timing.second.push_back(second_last * (u + 0.5 * height));
    if (k < count) height += changes[k] / static_cast<double>(count);
  }
  timing.first.back() = first_last;
  timing.second.back() = second_last;
  double steepest = 1.0, flattest = 1.0;
  for (std::size_t k = 0; k + 1 < timing.u.size(); ++k) {
    const double slope = (timing.second[k + 1] - timing.second[k]) / (timing.first[k + 1] - timing.first[k]);
    steepest = std::max(steepest, slope);
    flattest = std::min(flattest, slope);
  }
  const double designed = 1.0 / (limit - 1.0);
  const auto reach = [&](double slope) { return std::min(designed, (1.0 - kLeastRate) / (slope - 1.0)); };
  timing.least_alpha = -reach(steepest);
  timing.greatest_alpha = 1.0 + reach(1.0 / flattest);
  return timing;
}

}  // namespace

PairTiming align_fragments(const Motion& first, const Motion& second, double slope_limit) {
  check_durations(first.num_frames(), second.num_frames(), slope_limit);
  const double first_last = first.num_frames() - 1.0, second_last = second.num_frames() - 1.0;
  const Index count = first.num_frames() + second.num_frames() - 2;
  VectorXd changes = VectorXd::Zero(count);
  const auto features = representation::timing_features(first, second);
  if (features.weights.sum() > 0.0) {
    const double rate = first.frame_rate();
    const auto found = [&](const FrameMatrix& input, const FrameMatrix& output) {
      return height_changes(found_warp(input, output, features.weights, rate, slope_limit), count);
    };
    changes = 0.5 * (found(features.input, features.output) - found(features.output, features.input));
    const double knots = 2.0 * kSmoothing * rate;  // u has about two to a frame
    changes = align::smooth_differential_warp(changes, knots * knots);
  }
  draw_inside(changes, second_last / first_last, slope_limit);
  return curves_of(changes, first_last, second_last, slope_limit);
}

math::SmoothCurve blended_time(const PairTiming& timing, double alpha) {
  const double linear = std::clamp(alpha, timing.least_alpha, timing.greatest_alpha);
  std::vector<double> times{0.0};
  for (std::size_t k = 0; k + 1 < timing.u.size(); ++k) {
    const double p = timing.first[k + 1] - timing.first[k], q = timing.second[k + 1] - timing.second[k];
    times.push_back(times.back() + ((1.0 - linear) * p + linear * q) * std::pow(q / p, alpha - linear));
  }
  return {timing.u, std::move(times)};
}

}  // namespace strut::effort
