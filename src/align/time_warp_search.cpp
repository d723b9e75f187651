// SPDX-License-Identifier: MIT
// Symbols of the paper's 3.1 and what they are here:
//   p, q    input and output           m, n    their frames          L   slope limit
//   slot    a part of an output frame, s to each, n s in all          s   resolution; the paper has s = L
//   r       slots an input frame covers: repetitions, from s / L to k = s L
//   end     a place between slots, 0 ... n s
// best[x] is the least cost of the input frames so far when they end at x.
#include "align/time_warp_search.h"

#include "align/resample.h"
#include "align/warp_kernels.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <strut/core/error.h>

namespace strut::align::detail {
namespace {

constexpr double kUnreachable = std::numeric_limits<double>::infinity();

// The cost of an uneven choice among equals, as a share of a frame's energy: far below any difference that matters.
constexpr double kTieBreak = 1e-12;

// A signal is not halved below so many frames: a step that it does not see any more would mislead the search.
constexpr int kFewestFrames = 32;

// A cell with fewer counts to choose from costs no less.
constexpr int kFewestChoices = 4;

}  // namespace

void check_time_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                     const TimeWarpOptions& options) {
  check_signals(input, output);
  check_weights(options.weights, input.cols());
  if (options.exact_steps < 1) {
    throw InvalidArgument("exact_steps", "at least 1", std::to_string(options.exact_steps));
  }
  if (options.band_radius < 1) {
    throw InvalidArgument("band_radius", "at least 1", std::to_string(options.band_radius));
  }
  check_lengths(input.rows(), output.rows(), counts_of(options), options);
}

SlotSearch::SlotSearch(const Counts& counts, Ends ends)
    : counts_(counts), pad_(math::padded(counts.most) + kSlotLanes) {
  const double s = counts.resolution;
  for (int r = 0; r <= counts.most; ++r) {
    factor_.push_back(ends == Ends::kFixed || r == 0 ? 1.0 : s / r);
    share_.push_back(kTieBreak * (r - s) * (r - s));
  }
}

std::vector<int> SlotSearch::find(FrameDistances& distances, const std::vector<Interval>& reach) {
  const int m = distances.num_input_frames(), slots = distances.num_output_frames() * counts_.resolution;
  const auto width = static_cast<std::size_t>(slots + 1 + 2 * pad_);
  before_.assign(width, kUnreachable);
  best_.assign(width, kUnreachable);
  lengthened_.assign(width, 0.0);
  row_counts_.resize(width);
  chosen_.reset(counts_.most - counts_.least, static_cast<std::size_t>(m), num_cells(reach));
  const double energy = distances.mean_energy();
  uneven_.clear();
  for (const double share : share_) uneven_.push_back(share * (energy > 0.0 ? energy : 1.0));
  std::fill(at(best_, reach[0].first), at(best_, reach[0].last) + 1, 0.0);
  for (int row = 0; row < m; row += FrameDistances::kBlock) advance_block(distances, reach, row);
  return trace_back(reach);
}

void SlotSearch::advance_block(FrameDistances& distances, const std::vector<Interval>& reach, int row) {
  const int rows = std::min(FrameDistances::kBlock, distances.num_input_frames() - row), s = counts_.resolution;
  const Interval* ends = &reach[static_cast<std::size_t>(row)];
  columns_.clear();
  for (int i = 0; i < rows; ++i) columns_.push_back({ends[i].first / s, (ends[i + 1].last - 1) / s + 1});
  distances.compute(row, columns_);
  for (int i = 0; i < rows; ++i) advance(distances.row(i), ends[i], ends[i + 1]);
}

void SlotSearch::advance(const double* distances, const Interval& from, const Interval& to) {
  std::swap(before_, best_);
  std::fill(at(before_, from.first - counts_.most), at(before_, from.first), kUnreachable);
  std::fill(at(before_, from.last) + 1, at(before_, from.last + counts_.most + kSlotLanes), kUnreachable);
  const int s = counts_.resolution, frame = from.first / s;
  warp_kernels().lengthen((to.last - 1) / s + 1 - frame, s, distances + frame, at(lengthened_, frame * s));
  const int width = to.last - to.first + 1;
  warp_kernels().choose_counts(width, counts_.least, counts_.most, factor_.data(), uneven_.data(),
                               at(before_, to.first), at(lengthened_, to.first), at(best_, to.first),
                               row_counts_.data());
  chosen_.append(width, row_counts_.data());
}

std::vector<int> SlotSearch::trace_back(const std::vector<Interval>& reach) const {
  std::vector<int> path(reach.size());
  const Interval& last = reach.back();
  const double* costs = best_.data() + pad_;
  path.back() = static_cast<int>(std::min_element(costs + last.first, costs + last.last + 1) - costs);
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    path[i - 1] = path[i] - counts_.least - chosen_.at(i - 1, static_cast<std::size_t>(path[i] - reach[i].first));
  }
  return path;
}

TimeWarpSearch::TimeWarpSearch(int input_frames, const Eigen::Ref<const FrameMatrix>& output,
                               const TimeWarpOptions& options)
    : options_(options), counts_(counts_of(options)), origin_(output.colwise().mean()), search_(counts_, options.ends) {
  FrameMatrix coarser = weighted(output, origin_, options.weights);
  add_level(input_frames, coarser);
  const std::int64_t choices = std::max(counts_.most - counts_.least + 1, kFewestChoices);
  while (num_cells(levels_.back().reach) > options.exact_steps / choices) {
    const int m = (static_cast<int>(levels_.back().reach.size()) - 1) / 2;
    const int n = (levels_.back().distances.num_output_frames() + 1) / 2;
    if (std::min(m, n) < kFewestFrames || !fits(m, n, counts_, options.ends)) break;
    coarser = resampled(coarser, n);
    add_level(m, coarser);
  }
}

void TimeWarpSearch::add_level(int input_frames, const FrameMatrix& output) {
  const int slots = static_cast<int>(output.rows()) * counts_.resolution;
  levels_.push_back({slots, reachable(input_frames, slots, counts_, options_.ends), FrameDistances(output)});
}

TimeWarp TimeWarpSearch::find(const Eigen::Ref<const FrameMatrix>& input) {
  FrameMatrix coarser = weighted(input, origin_, options_.weights);
  for (Level& level : levels_) {
    const auto frames = static_cast<Eigen::Index>(level.reach.size()) - 1;
    if (frames != coarser.rows()) coarser = resampled(coarser, frames);
    level.distances.set_input(coarser);
  }
  std::vector<int> path;
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    if (path.empty()) {
      path = search_.find(level->distances, level->reach);
      continue;
    }
    path = stretched(path, std::prev(level)->slots, static_cast<int>(level->reach.size()) - 1, level->slots);
    path = search_.find(level->distances, band_around(std::move(path), radius(), counts_, level->reach));
  }
  return warp_of(path);
}

TimeWarp TimeWarpSearch::find_near(const TimeWarp& known) {
  std::vector<int> path{known.begin};
  for (const int r : known.repetitions) path.push_back(path.back() + r);
  Level& finest = levels_.front();
  return warp_of(search_.find(finest.distances, band_around(std::move(path), radius(), counts_, finest.reach)));
}

TimeWarp TimeWarpSearch::even() const {
  const Level& finest = levels_.front();
  TimeWarp warp = warp_of(even_path(static_cast<int>(finest.reach.size()) - 1, finest.slots, counts_, options_.ends));
  warp.is_exact = true;
  return warp;
}

TimeWarp TimeWarpSearch::warp_of(const std::vector<int>& path) const {
  TimeWarp warp;
  for (std::size_t i = 1; i < path.size(); ++i) warp.repetitions.push_back(path[i] - path[i - 1]);
  warp.resolution = counts_.resolution;
  warp.begin = path.front();
  warp.rest = levels_.front().slots - path.back();
  warp.counts_frames = options_.ends != Ends::kFixed;
  warp.is_exact = is_exact();
  return warp;
}

int TimeWarpSearch::radius() const {
  return std::min(options_.band_radius, levels_.front().distances.num_output_frames()) * counts_.resolution;
}

}  // namespace strut::align::detail
