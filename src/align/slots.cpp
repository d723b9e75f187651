// SPDX-License-Identifier: MIT
#include "align/slots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <strut/core/error.h>

namespace strut::align {
namespace detail {
namespace {

// s / L that misses a whole number by rounding is that number.
constexpr double kRounding = 1e-9;

// How near to both limits counts must come, as a share of the logarithm, for a resolution to be chosen.
constexpr double kNearLimit = 0.8;

// Sums of slots and counts stay far from the largest int.
constexpr std::int64_t kLargestSlots = std::int64_t{1} << 30;

Counts counts_at(double slope_limit, int resolution) {
  return {resolution, static_cast<int>(std::ceil(resolution / slope_limit - kRounding)),
          static_cast<int>(std::floor(resolution * slope_limit + kRounding))};
}

bool comes_near(double slope_limit, const Counts& counts) {
  const double wanted = kNearLimit * std::log(slope_limit);
  const double s = counts.resolution;
  return std::log(s / counts.least) >= wanted && std::log(counts.most / s) >= wanted;
}

bool begins_open(Ends ends) {
  return ends == Ends::kOpenBegin || ends == Ends::kOpen;
}

bool ends_open(Ends ends) {
  return ends == Ends::kOpenEnd || ends == Ends::kOpen;
}

std::string written(double x) {
  std::string text = std::to_string(x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// What would allow these lengths: a resolution if the limit does but its counts do not, else a slope limit.
std::string way_out(std::int64_t m, std::int64_t n, const TimeWarpOptions& options) {
  const double ratio = static_cast<double>(std::max(m, n)) / static_cast<double>(std::min(m, n));
  if (options.resolution != 0 && ratio <= options.slope_limit) {
    for (int s = options.resolution + 1; s <= kLargestResolution; ++s) {
      if (!fits(m, n, counts_at(options.slope_limit, s), options.ends)) continue;
      return "a resolution of " + std::to_string(s) + " would allow it";
    }
  }
  for (double limit = std::ceil(10.0 * ratio) / 10.0; limit <= kLargestSlopeLimit; limit += 0.1) {
    const int s = options.resolution == 0 ? default_resolution(limit) : options.resolution;
    if (fits(m, n, counts_at(limit, s), options.ends)) return "a slope limit of " + written(limit) + " would allow it";
  }
  return "trim the longer one";
}

}  // namespace

Counts counts_of(const TimeWarpOptions& options) {
  const int chosen = default_resolution(options.slope_limit);
  if (options.resolution < 0 || options.resolution > kLargestResolution) {
    throw InvalidArgument("resolution", "1 to " + std::to_string(kLargestResolution) + ", or 0 to have it chosen",
                          std::to_string(options.resolution));
  }
  return counts_at(options.slope_limit, options.resolution == 0 ? chosen : options.resolution);
}

bool fits(std::int64_t m, std::int64_t n, const Counts& counts, Ends ends) {
  const std::int64_t slots = n * counts.resolution;
  return m * counts.least <= slots && (ends != Ends::kFixed || m * counts.most >= slots);
}

void check_lengths(std::int64_t input_frames, std::int64_t output_frames, const Counts& counts,
                   const TimeWarpOptions& options) {
  const std::int64_t m = input_frames, s = counts.resolution;
  if (output_frames * s > kLargestSlots || m * counts.most > kLargestSlots) {
    throw InvalidArgument("output",
                          "at most " + std::to_string(kLargestSlots / std::max<std::int64_t>(s, counts.most)) +
                              " frames of either signal at resolution " + std::to_string(s),
                          std::to_string(std::max(m, output_frames)) + " frames",
                          "halve the frame rate, or align pieces");
  }
  if (fits(m, output_frames, counts, options.ends)) return;
  const std::int64_t fewest = (m * counts.least + s - 1) / s, most = m * counts.most / s;
  const std::string range = options.ends != Ends::kFixed ? "at least " + std::to_string(fewest)
                            : fewest <= most             ? std::to_string(fewest) + " to " + std::to_string(most)
                                                         : "another number of";
  throw InvalidArgument("output",
                        range + " frames for an input of " + std::to_string(m) + " frames at slope limit " +
                            written(options.slope_limit) + " and resolution " + std::to_string(s),
                        std::to_string(output_frames) + " frames", way_out(m, output_frames, options));
}

std::vector<Interval> reachable(int input_frames, int slots, const Counts& counts, Ends ends) {
  const Interval begin{0, begins_open(ends) ? slots : 0}, end{ends_open(ends) ? 0 : slots, slots};
  std::vector<Interval> reach(static_cast<std::size_t>(input_frames) + 1);
  for (int i = 0; i <= input_frames; ++i) {
    const int left = input_frames - i;
    reach[static_cast<std::size_t>(i)] = {std::max(begin.first + i * counts.least, end.first - left * counts.most),
                                          std::min(begin.last + i * counts.most, end.last - left * counts.least)};
  }
  return reach;
}

std::int64_t num_cells(const std::vector<Interval>& reach) {
  std::int64_t cells = 0;
  for (std::size_t i = 1; i < reach.size(); ++i) cells += reach[i].last - reach[i].first + 1;
  return cells;
}

std::vector<int> even_path(int input_frames, int slots, const Counts& counts, Ends ends) {
  const std::int64_t m = input_frames;
  const std::int64_t covered = std::clamp<std::int64_t>(slots, m * counts.least, m * counts.most);
  const std::int64_t free = slots - covered;
  const std::int64_t begin = !begins_open(ends) ? 0 : ends_open(ends) ? free / 2 : free;
  std::vector<int> path(static_cast<std::size_t>(m) + 1);
  for (std::int64_t i = 0; i <= m; ++i) path[static_cast<std::size_t>(i)] = static_cast<int>(begin + i * covered / m);
  return path;
}

std::vector<Interval> band_around(std::vector<int> path, int radius, const Counts& counts,
                                  const std::vector<Interval>& reach) {
  // Every reachable end has a reachable one after it, so a path that keeps to both always goes on.
  path[0] = std::clamp(path[0], reach[0].first, reach[0].last);
  for (std::size_t i = 1; i < path.size(); ++i) {
    path[i] = std::clamp(path[i], std::max(reach[i].first, path[i - 1] + counts.least),
                         std::min(reach[i].last, path[i - 1] + counts.most));
  }
  std::vector<Interval> band(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    band[i] = {std::max(reach[i].first, path[i] - radius), std::min(reach[i].last, path[i] + radius)};
    if (i == 0) continue;
    band[i] = {std::max(band[i].first, band[i - 1].first + counts.least),
               std::min(band[i].last, band[i - 1].last + counts.most)};
  }
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    band[i - 1] = {std::max(band[i - 1].first, band[i].first - counts.most),
                   std::min(band[i - 1].last, band[i].last - counts.least)};
  }
  return band;
}

}  // namespace detail

int default_resolution(double slope_limit) {
  if (!(slope_limit >= 1.0) || slope_limit > kLargestSlopeLimit) {
    throw InvalidArgument("slope_limit", "1 to " + detail::written(kLargestSlopeLimit), detail::written(slope_limit));
  }
  int resolution = static_cast<int>(std::ceil(slope_limit - detail::kRounding));
  while (resolution < kLargestResolution &&
         !detail::comes_near(slope_limit, detail::counts_at(slope_limit, resolution))) {
    ++resolution;
  }
  return resolution;
}

}  // namespace strut::align
