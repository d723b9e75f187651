// SPDX-License-Identifier: MIT
// Symbols of the paper's 3.1 and what they are here:
//   p, q    input and output           m, n    their frames          s   slope limit
//   slot    a frame of the output lengthened s times, n s in all     k   repetition limit s^2
//   r       repetitions of one input frame
// best[x] is the least cost of the input frames so far when they fill the slots [0, x).
#include "align/signals.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <strut/align/time_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kUnreachable = std::numeric_limits<double>::infinity();

// Input frames whose distances are computed by one matrix product: large enough to pay, small enough that the block's
// rectangle does not reach far beyond the reachable slots.
constexpr int kBlock = 24;

// The cost of an uneven choice among equals, as a share of a frame's energy: far below any difference that matters.
constexpr double kTieBreak = 1e-12;

void check_lengths(int m, int n, int s) {
  if (s < 1 || s > kLargestSlopeLimit) {
    throw InvalidArgument("slope_limit", "1 to " + std::to_string(kLargestSlopeLimit), std::to_string(s));
  }
  if (m <= n * s && n <= m * s) return;
  const int needed = (std::max(m, n) + std::min(m, n) - 1) / std::min(m, n);
  throw InvalidArgument("output",
                        "between 1/" + std::to_string(s) + " and " + std::to_string(s) + " times the input's " +
                            std::to_string(m) + " frames",
                        std::to_string(n) + " frames",
                        needed <= kLargestSlopeLimit ? "a slope limit of " + std::to_string(needed) + " would allow it"
                                                     : "trim the longer one");
}

/// The slots [first, last] that can be filled after a number of input frames.
struct Reach {
  int first, last;
  Reach(int frames, int m, int slots, int k)
      : first(std::max(frames, slots - (m - frames) * k)), last(std::min(frames * k, slots - (m - frames))) {}
};

/// One pass of dynamic programming. Rows are kept with k unreachable slots on either side, so that no step looks
/// outside.
class TimeWarp {
 public:
  TimeWarp(const detail::FrameDistances& distances, int slope_limit)
      : distances_(distances),
        m_(distances.num_input_frames()),
        s_(slope_limit),
        k_(slope_limit * slope_limit),
        slots_(distances.num_output_frames() * slope_limit) {}

  std::vector<int> solve() {
    const auto width = static_cast<std::size_t>(slots_ + 2 * k_ + 1);
    best_.assign(width, kUnreachable);
    before_.assign(width, kUnreachable);
    passed_.assign(width, 0.0);
    at(best_, 0) = 0.0;
    const double energy = distances_.mean_energy();
    for (int r = 0; r <= k_; ++r) uneven_.push_back(kTieBreak * (energy > 0.0 ? energy : 1.0) * r * r);
    for (int row = 0; row < m_; row += kBlock) advance_block(row, std::min(kBlock, m_ - row));
    return trace_back();
  }

 private:
  template <typename T>
  T& at(std::vector<T>& row, int slot) const {
    return row[static_cast<std::size_t>(slot + k_)];
  }

  void advance_block(int row, int rows) {
    const int col = Reach(row, m_, slots_, k_).first / s_;
    const int cols = (Reach(row + rows, m_, slots_, k_).last - 1) / s_ + 1 - col;
    block_.resize(std::max<Eigen::Index>(block_.rows(), rows), std::max<Eigen::Index>(block_.cols(), cols));
    distances_.compute(row, rows, col, cols, block_);
    for (int i = 0; i < rows; ++i) advance(row + i, &block_(i, 0), col);
  }

  /// From `frame` input frames to one more; `distance[j - col]` is the frame's distance to output frame j.
  void advance(int frame, const double* distance, int col) {
    const Reach from(frame, m_, slots_, k_), to(frame + 1, m_, slots_, k_);
    sum_distances(distance, col, from.first, to.last);
    // A frame that fills [x, y) costs passed[y] - passed[x].
    for (int x = from.first; x <= from.last; ++x) at(before_, x) = at(best_, x) - at(passed_, x);
    for (int pad = 1; pad <= k_; ++pad) {
      at(before_, from.first - pad) = kUnreachable;
      at(before_, from.last + pad) = kUnreachable;
    }
    choose(to);
  }

  /// passed[x] = summed distance of the slots [start of first's output frame, x).
  void sum_distances(const double* distance, int col, int first, int last) {
    double sum = 0.0;
    double* passed = &at(passed_, first / s_ * s_);
    for (int j = first / s_; j * s_ <= last; ++j) {
      const double here = j * s_ < last ? distance[j - col] : 0.0;
      for (int part = 0; part < s_; ++part) *passed++ = sum + part * here;
      sum += s_ * here;
    }
  }

  /// The best last repetition count for every slot, without a branch: the processor could not foresee it.
  void choose(const Reach& to) {
    const int width = to.last - to.first + 1;
    row_begin_.push_back(counts_.size());
    counts_.resize(counts_.size() + static_cast<std::size_t>(width));
    std::uint8_t* counts = &counts_[row_begin_.back()];
    for (int x = 0; x < width; ++x) {
      const double* before = &at(before_, to.first + x);
      double best = kUnreachable;
      int count = 0;
      for (int r = 1; r <= k_; ++r) {
        const double candidate = before[-r] + uneven_[static_cast<std::size_t>(r)];
        count += (r - count) & -static_cast<int>(candidate < best);
        best = std::min(candidate, best);
      }
      counts[x] = static_cast<std::uint8_t>(count);
      at(best_, to.first + x) = best + at(passed_, to.first + x);
    }
  }

  std::vector<int> trace_back() const {
    std::vector<int> repetitions(static_cast<std::size_t>(m_));
    int slot = slots_;
    for (int frame = m_; frame > 0; --frame) {
      const auto row = static_cast<std::size_t>(frame - 1);
      const auto column = static_cast<std::size_t>(slot - Reach(frame, m_, slots_, k_).first);
      repetitions[row] = counts_[row_begin_[row] + column];
      slot -= repetitions[row];
    }
    return repetitions;
  }

  const detail::FrameDistances& distances_;
  int m_, s_, k_, slots_;
  std::vector<double> uneven_;  // what a count costs beside its distances
  std::vector<double> best_, before_, passed_;
  FrameMatrix block_;
  std::vector<std::uint8_t> counts_;    // of every reachable slot after every input frame
  std::vector<std::size_t> row_begin_;  // where an input frame's counts begin
};

}  // namespace

std::vector<int> time_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                           int slope_limit, const Eigen::VectorXd& weights) {
  const detail::FrameDistances distances(input, output, weights);
  check_lengths(distances.num_input_frames(), distances.num_output_frames(), slope_limit);
  return TimeWarp(distances, slope_limit).solve();
}

}  // namespace strut::align
