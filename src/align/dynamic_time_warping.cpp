// SPDX-License-Identifier: MIT
// D(i, j) = min over steps (di, dj) of D(i - di, j - dj) + (di + dj) d(i, j), at the cells that some path reaches. Rows
// of D are kept two back; which step was taken is kept in two bits for every cell.
#include "align/packed_rows.h"
#include "align/resample.h"
#include "align/signals.h"
#include "align/warp_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <strut/align/dynamic_time_warping.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

using detail::Columns;
using detail::FrameDistances;
using Path = std::vector<FramePair>;

constexpr double kUnreachable = std::numeric_limits<double>::infinity();

constexpr int kFewestFrames = 32;  // a signal is not halved below
constexpr int kPad = 2;            // cells before a row, where no path comes from

struct Step {
  int input, output;
};
using Steps = std::array<Step, 3>;

// In the order of the kernels (warp_kernels.h).
Steps steps_of(LocalConstraint constraint) {
  if (constraint == LocalConstraint::kTypeI) return {{{1, 1}, {1, 0}, {0, 1}}};
  return {{{1, 1}, {2, 1}, {1, 2}}};
}

void check_options(const DynamicTimeWarpingOptions& options, Eigen::Index dofs) {
  detail::check_weights(options.weights, dofs);
  if (options.exact_cells < 1) {
    throw InvalidArgument("exact_cells", "at least 1", std::to_string(options.exact_cells));
  }
  if (options.band_radius < 1) {
    throw InvalidArgument("band_radius", "at least 1", std::to_string(options.band_radius));
  }
}

void check_lengths(std::int64_t m, std::int64_t n, LocalConstraint constraint) {
  if (std::max(m, n) > std::int64_t{1} << 29) {
    throw InvalidArgument("output", "at most 2^29 frames of either signal", std::to_string(std::max(m, n)) + " frames",
                          "halve the frame rate, or align pieces");
  }
  if (constraint == LocalConstraint::kTypeI) return;
  if (m - 1 <= 2 * (n - 1) && n - 1 <= 2 * (m - 1)) return;
  throw InvalidArgument("output", "between half and twice the steps of the input's " + std::to_string(m) + " frames",
                        std::to_string(n) + " frames", "Type I allows any lengths; or trim the longer one");
}

/// The output frames that paths may reach with every input frame.
std::vector<Columns> reachable(int m, int n, LocalConstraint constraint) {
  std::vector<Columns> reach(static_cast<std::size_t>(m), {0, n});
  if (constraint == LocalConstraint::kTypeI) return reach;
  for (int i = 0; i < m; ++i) {
    const int left = m - 1 - i;
    Columns& here = reach[static_cast<std::size_t>(i)];
    here.first = std::max((i + 1) / 2, n - 1 - 2 * left);
    here.end = std::max(here.first, std::min(2 * i, n - 1 - (left + 1) / 2)) + 1;
  }
  return reach;
}

std::int64_t num_cells(const std::vector<Columns>& reach) {
  std::int64_t cells = 0;
  for (const Columns& row : reach) cells += row.end - row.first;
  return cells;
}

/// The dynamic program over reachable cells.
class CellSearch {
 public:
  CellSearch(FrameDistances& distances, LocalConstraint constraint, const std::vector<Columns>& reach)
      : distances_(distances), constraint_(constraint), reach_(reach) {
    rows_.fill(math::AlignedVector<double>(
        static_cast<std::size_t>(math::padded(distances.num_output_frames()) + detail::kSlotLanes + kPad),
        kUnreachable));
    taken_.resize(rows_[0].size());
    steps_.reset(2, reach.size(), num_cells(reach));
  }

  /// The least cost; infinite if no path keeps within reach.
  double fill() {
    std::vector<Columns> block;
    const int m = static_cast<int>(reach_.size());
    for (int row = 0; row < m; row += FrameDistances::kBlock) {
      const auto begin = reach_.begin() + row;
      block.assign(begin, begin + std::min(FrameDistances::kBlock, m - row));
      distances_.compute(row, block);
      for (int i = 0; i < static_cast<int>(block.size()); ++i) advance(row + i, distances_.row(i));
    }
    return back(m - 1, 0)[distances_.num_output_frames() - 1];
  }

  [[nodiscard]] Path trace_back() const {
    const Steps steps = steps_of(constraint_);
    Path path{{static_cast<int>(reach_.size()) - 1, distances_.num_output_frames() - 1}};
    while (!(path.back() == FramePair{0, 0})) {
      const FramePair at = path.back();
      const auto row = static_cast<std::size_t>(at.input);
      const Step step =
          steps[static_cast<std::size_t>(steps_.at(row, static_cast<std::size_t>(at.output - reach_[row].first)))];
      path.push_back({at.input - step.input, at.output - step.output});
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  /// Row i - di of D; [j] is its cell j.
  double* back(int i, int di) { return rows_[static_cast<std::size_t>((i + 3 - di) % 3)].data() + kPad; }

  /// What row i looks at of row i - di, beyond that row's reach.
  void clear_beyond(int i, int di) {
    const Columns here = reach_[static_cast<std::size_t>(i)];
    const Columns before = i >= di ? reach_[static_cast<std::size_t>(i - di)] : Columns{0, 0};
    double* row = back(i, di);
    if (here.first - kPad < before.first) std::fill(row + here.first - kPad, row + before.first, kUnreachable);
    const int begin = std::max(here.first - kPad, before.end), end = here.end + detail::kSlotLanes;
    if (begin < end) std::fill(row + begin, row + end, kUnreachable);
  }

  void advance(int i, const double* distance) {
    const Columns here = reach_[static_cast<std::size_t>(i)];
    const int width = here.end - here.first;
    clear_beyond(i, 1);
    clear_beyond(i, 2);
    double* best = back(i, 0);
    const double *one = back(i, 1) + here.first, *two = back(i, 2) + here.first;
    const detail::WarpKernels& kernels = detail::warp_kernels();
    if (constraint_ == LocalConstraint::kTypeIII) {
      kernels.step_type_iii(width, one, two, distance + here.first, best + here.first, taken_.data());
    } else {
      kernels.step_type_i(width, one, distance + here.first, best + here.first, taken_.data());
    }
    if (i == 0) best[0] = 2.0 * distance[0];
    if (constraint_ == LocalConstraint::kTypeI) step_along(here, distance, best);
    steps_.append(width, taken_.data());
  }

  /// The step that stays with the input frame.
  void step_along(const Columns& here, const double* distance, double* best) {
    double before = best[here.first];
    for (int j = here.first + 1; j < here.end; ++j) {
      const double candidate = before + distance[j];
      const bool is_less = candidate < best[j];
      taken_[static_cast<std::size_t>(j - here.first)] = is_less ? 2 : taken_[static_cast<std::size_t>(j - here.first)];
      before = is_less ? candidate : best[j];
      best[j] = before;
    }
  }

  FrameDistances& distances_;
  LocalConstraint constraint_;
  const std::vector<Columns>& reach_;
  std::array<math::AlignedVector<double>, 3> rows_;  // of D: rows_[i % 3]
  std::vector<std::uint16_t> taken_;
  detail::PackedRows steps_;
};

/// The part of `reach` within `radius` of a path of a coarser pair, of `from` frames.
std::vector<Columns> band_around(const Path& path, FramePair from, int n, int radius, std::vector<Columns> reach) {
  const int m = static_cast<int>(reach.size());
  std::vector<Columns> coarse(static_cast<std::size_t>(from.input), {from.output, 0});
  for (std::size_t k = 0; k < path.size(); ++k) {
    // A step of two passes over an input frame between.
    const int first = k > 0 ? path[k - 1].input + 1 : 0;
    for (int i = first; i < path[k].input; ++i)
      coarse[static_cast<std::size_t>(i)] = {path[k - 1].output, path[k].output + 1};
    Columns& row = coarse[static_cast<std::size_t>(path[k].input)];
    row = {std::min(row.first, path[k].output), std::max(row.end, path[k].output + 1)};
  }
  const double scale = static_cast<double>(n) / from.output;
  for (int i = 0; i < m; ++i) {
    const Columns& row = coarse[static_cast<std::size_t>(std::int64_t{i} * from.input / m)];
    Columns& here = reach[static_cast<std::size_t>(i)];
    const int first = static_cast<int>(std::floor(row.first * scale)) - radius;
    const int end = static_cast<int>(std::ceil(row.end * scale)) + radius;
    here.first = std::min(std::max(here.first, first), here.end - 1);
    here.end = std::max(std::min(here.end, end), here.first + 1);
  }
  return reach;
}

struct Solution {
  Path path;
  double cost = 0.0;
  bool is_exact = true;
};

std::optional<Solution> solve_within(FrameDistances& distances, LocalConstraint constraint,
                                     const std::vector<Columns>& reach) {
  CellSearch search(distances, constraint, reach);
  const double cost = search.fill();
  if (!(cost < kUnreachable)) return std::nullopt;
  return Solution{search.trace_back(), cost, true};
}

/// Half as many frames of either signal, about: paths must fit them too.
FramePair half_of(int m, int n, LocalConstraint constraint) {
  const int input = (m + 1) / 2, output = (n + 1) / 2;
  if (constraint == LocalConstraint::kTypeI) return {input, output};
  return {input, std::clamp(output, input / 2 + 1, 2 * input - 1)};
}

/// The best path, or, of a pair with too many cells, the best near that of the pair at half the rate.
Solution solve(const FrameMatrix& input, const FrameMatrix& output, LocalConstraint constraint,
               const DynamicTimeWarpingOptions& options) {
  const int m = static_cast<int>(input.rows()), n = static_cast<int>(output.rows());
  const std::vector<Columns> reach = reachable(m, n, constraint);
  FrameDistances distances(output);
  distances.set_input(input);
  const FramePair half = half_of(m, n, constraint);
  if (num_cells(reach) <= options.exact_cells || std::min(half.input, half.output) < kFewestFrames) {
    return *solve_within(distances, constraint, reach);
  }
  const Path coarse =
      solve(detail::resampled(input, half.input), detail::resampled(output, half.output), constraint, options).path;
  // Along the slope limit a path at the full rate may need more room.
  for (int radius = std::min(options.band_radius, n);; radius = std::min(4 * radius, n)) {
    auto found = solve_within(distances, constraint, band_around(coarse, half, n, radius, reach));
    if (!found) continue;
    found->is_exact = false;
    return *std::move(found);
  }
}

/// A step of two frames matches both of them with the frame at its end. Every output frame is shared out evenly.
Correspondence correspondence_of(const std::vector<FramePair>& path, int m, int n) {
  std::vector<FramePair> matches{path.front()};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const FramePair from = path[k - 1], to = path[k];
    if (to.input - from.input == 2) matches.push_back({to.input - 1, to.output});
    if (to.output - from.output == 2) matches.push_back({to.input, to.output - 1});
    matches.push_back(to);
  }
  Eigen::VectorXd sharers = Eigen::VectorXd::Zero(n);
  for (const FramePair& match : matches) sharers[match.output] += 1.0;
  Correspondence result{Eigen::VectorXd::Zero(m)};
  for (const FramePair& match : matches) result.differential_warp[match.input] += 1.0 / sharers[match.output];
  return result;
}

}  // namespace

DynamicTimeWarpingResult dynamic_time_warping(const Eigen::Ref<const FrameMatrix>& input,
                                              const Eigen::Ref<const FrameMatrix>& output, LocalConstraint constraint,
                                              const DynamicTimeWarpingOptions& options) {
  detail::check_signals(input, output);
  check_options(options, input.cols());
  check_lengths(input.rows(), output.rows(), constraint);
  const int m = static_cast<int>(input.rows()), n = static_cast<int>(output.rows());
  const Eigen::RowVectorXd origin = output.colwise().mean();
  Solution solution = solve(detail::weighted(input, origin, options.weights),
                            detail::weighted(output, origin, options.weights), constraint, options);
  Correspondence correspondence = correspondence_of(solution.path, m, n);
  return {std::move(correspondence), std::move(solution.path), solution.cost, solution.is_exact};
}

}  // namespace strut::align
