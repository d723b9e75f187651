// SPDX-License-Identifier: MIT
#include "learn/time_warp_smoothing.h"

#include <array>
#include <limits>
#include <map>
#include <tuple>

#include <strut/align/correspondence.h>

namespace strut::learn {
namespace {

constexpr std::array kCandidates = {0.03, 0.06, 0.1, 0.15, 0.25, 0.4};  // [s]
constexpr double kUnjudged = 0.1;                                       // [s]

/// Pairs of one stretch of input.
using Sharers = std::vector<const PairWarp*>;

std::vector<Sharers> by_stretch(const std::vector<PairWarp>& warps) {
  std::map<std::tuple<int, int, int>, Sharers> found;
  for (const PairWarp& warp : warps) {
    found[{warp.pair->input_clip, warp.pair->input_frames.begin, warp.pair->input_frames.end}].push_back(&warp);
  }
  std::vector<Sharers> stretches;
  for (auto& [stretch, sharers] : found) stretches.push_back(std::move(sharers));
  return stretches;
}

Eigen::VectorXd cumulative(const Eigen::VectorXd& w) {
  Eigen::VectorXd sums(w.size());
  double sum = 0.0;
  for (Eigen::Index t = 0; t < w.size(); ++t) sums[t] = sum += w[t];
  return sums;
}

/// Adds the distances of predicted from mapped moments [frames]; nothing where no other pair can predict.
void add_error(const Sharers& sharers, const PairWarp& left_out, double smoothness, double& sum, double& frames) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(left_out.differential_warp.size());
  double others = 0.0;
  for (const PairWarp* other : sharers) {
    if (other->pair->output_clip == left_out.pair->output_clip) continue;
    mean += align::smooth_differential_warp(other->differential_warp, smoothness).array().log().matrix();
    others += 1.0;
  }
  if (others == 0.0) return;
  Eigen::VectorXd predicted = (mean / others).array().exp();
  predicted *= left_out.differential_warp.sum() / predicted.sum();
  sum += (cumulative(predicted) - cumulative(left_out.differential_warp)).cwiseAbs().sum();
  frames += static_cast<double>(mean.size());
}

}  // namespace

double choose_time_warp_smoothing(const std::vector<PairWarp>& warps, double frame_rate) {
  const std::vector<Sharers> stretches = by_stretch(warps);
  double best = kUnjudged;
  double least = std::numeric_limits<double>::infinity();
  for (const double reach : kCandidates) {
    const double smoothness = reach * frame_rate * reach * frame_rate;
    double sum = 0.0, frames = 0.0;
    for (const Sharers& sharers : stretches) {
      for (const PairWarp* left_out : sharers) add_error(sharers, *left_out, smoothness, sum, frames);
    }
    if (frames == 0.0) return kUnjudged;
    if (sum < least) {
      least = sum;
      best = reach;
    }
  }
  return best;
}

}  // namespace strut::learn
