// SPDX-License-Identifier: MIT
#include "align/time_warp_search.h"

#include <strut/align/time_warp.h>

namespace strut::align {

Correspondence TimeWarp::correspondence() const {
  Correspondence result = from_repetitions(repetitions, resolution);
  result.output_begin = static_cast<double>(begin) / resolution;
  result.output_rest = static_cast<double>(rest) / resolution;
  return result;
}

TimeWarp time_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                   const TimeWarpOptions& options) {
  detail::check_time_warp(input, output, options);
  detail::TimeWarpSearch search(static_cast<int>(input.rows()), output, options);
  // A sum over every slot is the same for any repetition of equal frames.
  if (detail::is_constant(input, options.weights) &&
      (options.ends == Ends::kFixed || detail::is_constant(output, options.weights))) {
    return search.even();
  }
  return search.find(input);
}

}  // namespace strut::align
