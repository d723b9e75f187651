// SPDX-License-Identifier: MIT
// What a time warp costs, written out from its definition (time_warp.h), and the least cost of all that are allowed, by
// trying them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Core>

#include <strut/align/time_warp.h>
#include <strut/math/frame_matrix.h>

namespace strut::align::test {

inline double cost_of(const FrameMatrix& p, const FrameMatrix& q, const TimeWarp& warp,
                      const Eigen::VectorXd& weights = {}) {
  double cost = 0.0;
  int slot = warp.begin;
  for (std::size_t t = 0; t < warp.repetitions.size(); ++t) {
    const int count = warp.repetitions[t];
    double sum = 0.0;
    for (int k = 0; k < count; ++k, ++slot) {
      const Eigen::RowVectorXd difference = p.row(static_cast<Eigen::Index>(t)) - q.row(slot / warp.resolution);
      sum += weights.size() == 0 ? difference.squaredNorm() : difference.cwiseAbs2().dot(weights.transpose());
    }
    cost += warp.counts_frames ? sum * warp.resolution / count : sum;
  }
  return cost;
}

/// Calls with every time warp that is allowed.
inline void for_each_warp(int input_frames, int output_frames, double slope_limit, int resolution, Ends ends,
                          const std::function<void(const TimeWarp&)>& visit) {
  const int slots = output_frames * resolution;
  const int least = static_cast<int>(std::ceil(resolution / slope_limit - 1e-9));
  const int most = static_cast<int>(std::floor(resolution * slope_limit + 1e-9));
  const bool begins_open = ends == Ends::kOpenBegin || ends == Ends::kOpen;
  const bool ends_open = ends == Ends::kOpenEnd || ends == Ends::kOpen;
  TimeWarp warp;
  warp.resolution = resolution;
  warp.counts_frames = ends != Ends::kFixed;
  const std::function<void(int)> extend = [&](int filled) {
    if (static_cast<int>(warp.repetitions.size()) == input_frames) {
      warp.rest = slots - filled;
      if (warp.rest == 0 || ends_open) visit(warp);
      return;
    }
    for (int r = least; r <= most && filled + r <= slots; ++r) {
      warp.repetitions.push_back(r);
      extend(filled + r);
      warp.repetitions.pop_back();
    }
  };
  for (warp.begin = 0; warp.begin <= (begins_open ? slots : 0); ++warp.begin) extend(warp.begin);
}

}  // namespace strut::align::test
