// SPDX-License-Identifier: MIT
#include "align/resample.h"

#include <algorithm>
#include <cmath>

namespace strut::align::detail {

FrameMatrix resampled(const FrameMatrix& signal, Eigen::Index frames) {
  FrameMatrix result(frames, signal.cols());
  const double step = static_cast<double>(signal.rows()) / static_cast<double>(frames);
  for (Eigen::Index i = 0; i < frames; ++i) {
    const double begin = static_cast<double>(i) * step;
    const double end = std::min(begin + step, static_cast<double>(signal.rows()));
    result.row(i).setZero();
    for (auto t = static_cast<Eigen::Index>(begin); static_cast<double>(t) < end; ++t) {
      const double covered = std::min(end, static_cast<double>(t + 1)) - std::max(begin, static_cast<double>(t));
      result.row(i) += covered / step * signal.row(t);
    }
  }
  return result;
}

std::vector<int> stretched(const std::vector<int>& path, int path_slots, int frames, int slots) {
  const double last = static_cast<double>(path.size() - 1);
  std::vector<int> result(static_cast<std::size_t>(frames) + 1);
  for (int i = 0; i <= frames; ++i) {
    const double place = last * i / frames;
    const auto before = std::min(static_cast<std::size_t>(place), path.size() - 2);
    const double share = place - static_cast<double>(before);
    const double end = (1.0 - share) * path[before] + share * path[before + 1];
    result[static_cast<std::size_t>(i)] = static_cast<int>(std::lround(end * slots / path_slots));
  }
  return result;
}

}  // namespace strut::align::detail
