// SPDX-License-Identifier: MIT
// D(i, j) = min over steps (di, dj) of D(i - di, j - dj) + (di + dj) d(i, j). Rows of D are kept two back; which step
// was taken is kept for every cell.
#include "align/signals.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <strut/align/dynamic_time_warping.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kUnreachable = std::numeric_limits<double>::infinity();
constexpr int kBlock = 32;  // input frames whose distances are computed by one matrix product

struct Step {
  int input, output;
};
using Steps = std::array<Step, 3>;

Steps steps_of(LocalConstraint constraint) {
  if (constraint == LocalConstraint::kTypeI) return {{{1, 1}, {1, 0}, {0, 1}}};
  return {{{1, 1}, {2, 1}, {1, 2}}};
}

void check_lengths(int m, int n, LocalConstraint constraint) {
  if (constraint == LocalConstraint::kTypeI) return;
  if (m - 1 <= 2 * (n - 1) && n - 1 <= 2 * (m - 1)) return;
  throw InvalidArgument("output", "between half and twice the steps of the input's " + std::to_string(m) + " frames",
                        std::to_string(n) + " frames", "Type I allows any lengths; or trim the longer one");
}

/// The step taken into every cell (m x n, row by row), and the cost at the last cell.
struct Table {
  std::vector<std::uint8_t> taken;
  double cost = 0.0;
};

Table fill(const detail::FrameDistances& distances, const Steps& steps) {
  const int m = distances.num_input_frames(), n = distances.num_output_frames();
  const auto width = static_cast<std::size_t>(n + 2);  // two unreachable cells before each row
  std::array<std::vector<double>, 3> rows;             // of D: rows[i % 3]
  rows.fill(std::vector<double>(width, kUnreachable));
  Table table{std::vector<std::uint8_t>(static_cast<std::size_t>(m) * static_cast<std::size_t>(n)), 0.0};
  FrameMatrix block(std::min(m, kBlock), n);
  for (int i = 0; i < m; ++i) {
    if (i % kBlock == 0) distances.compute(i, std::min(kBlock, m - i), 0, n, block);
    std::array<const double*, 3> back{};
    for (int di = 0; di < 3; ++di) {
      back[static_cast<std::size_t>(di)] = rows[static_cast<std::size_t>((i + 3 - di) % 3)].data() + 2;
    }
    double* here = rows[static_cast<std::size_t>(i % 3)].data() + 2;
    std::uint8_t* taken = &table.taken[static_cast<std::size_t>(i) * static_cast<std::size_t>(n)];
    for (int j = 0; j < n; ++j) {
      const double distance = block(i % kBlock, j);
      here[j] = i == 0 && j == 0 ? 2.0 * distance : kUnreachable;
      for (std::size_t k = 0; k < steps.size(); ++k) {
        const Step step = steps[k];
        const double candidate =
            back[static_cast<std::size_t>(step.input)][j - step.output] + (step.input + step.output) * distance;
        if (candidate >= here[j]) continue;
        here[j] = candidate;
        taken[j] = static_cast<std::uint8_t>(k);
      }
    }
  }
  table.cost = rows[static_cast<std::size_t>((m - 1) % 3)][static_cast<std::size_t>(n - 1 + 2)];
  return table;
}

std::vector<FramePair> trace_back(const Table& table, const Steps& steps, int m, int n) {
  std::vector<FramePair> path{{m - 1, n - 1}};
  while (!(path.back() == FramePair{0, 0})) {
    const FramePair at = path.back();
    const auto cell =
        static_cast<std::size_t>(at.input) * static_cast<std::size_t>(n) + static_cast<std::size_t>(at.output);
    const Step step = steps[table.taken[cell]];
    path.push_back({at.input - step.input, at.output - step.output});
  }
  std::reverse(path.begin(), path.end());
  return path;
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
                                              const Eigen::VectorXd& weights) {
  const detail::FrameDistances distances(input, output, weights);
  const int m = distances.num_input_frames(), n = distances.num_output_frames();
  check_lengths(m, n, constraint);
  const Steps steps = steps_of(constraint);
  const Table table = fill(distances, steps);
  std::vector<FramePair> path = trace_back(table, steps, m, n);
  Correspondence correspondence = correspondence_of(path, m, n);
  return {std::move(correspondence), std::move(path), table.cost};
}

}  // namespace strut::align
