// SPDX-License-Identifier: MIT
#include "align/signals.h"
#include "align/space_warp_solver.h"

#include <cstdint>
#include <numeric>
#include <string>

#include <strut/align/space_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

void check_time_warp(const TimeWarp& warp, Eigen::Index input_frames, Eigen::Index output_frames) {
  if (warp.resolution < 1) throw InvalidArgument("resolution", "at least 1", std::to_string(warp.resolution));
  const auto size = static_cast<Eigen::Index>(warp.repetitions.size());
  const std::int64_t slots = std::int64_t{warp.resolution} * output_frames;
  const std::int64_t sum =
      std::accumulate(warp.repetitions.begin(), warp.repetitions.end(), std::int64_t{warp.begin} + warp.rest);
  bool positive = warp.begin >= 0 && warp.rest >= 0;
  for (const int r : warp.repetitions) positive = positive && r > 0;
  if (size == input_frames && sum == slots && positive) return;
  throw InvalidArgument(
      "time_warp",
      std::to_string(input_frames) + " positive counts that sum to " + std::to_string(slots) + ", the ends included",
      std::to_string(size) + " counts that sum to " + std::to_string(sum));
}

}  // namespace

namespace detail {

void check_space_warp(const SpaceWarpOptions& options) {
  for (const double smoothness : {options.scale_smoothness, options.offset_smoothness}) {
    if (smoothness >= 0.0 && smoothness <= kLargestSmoothness) continue;
    throw InvalidArgument("smoothness", "0 to 1e12", std::to_string(smoothness));
  }
}

}  // namespace detail

FrameMatrix SpaceWarp::apply(const Eigen::Ref<const FrameMatrix>& input) const {
  return scale.cwiseProduct(input) + offset;
}

SpaceWarp space_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                     const TimeWarp& time_warp, const SpaceWarpOptions& options) {
  detail::check_signals(input, output);
  detail::check_space_warp(options);
  check_time_warp(time_warp, input.rows(), output.rows());
  SpaceWarp warp;
  detail::SpaceWarpSolver(input, output, options).solve(time_warp, warp);
  return warp;
}

}  // namespace strut::align
