// SPDX-License-Identifier: MIT
// The time-warp stage against one output, for one input after another: iterative motion warping asks once a round. What
// depends on the output alone is kept, and so is the memory.
#pragma once

#include "align/packed_rows.h"
#include "align/signals.h"
#include "align/slots.h"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <strut/align/time_warp.h>
#include <strut/math/aligned.h>
#include <strut/math/frame_matrix.h>

namespace strut::align::detail {

/// Throws as time_warp does.
void check_time_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                     const TimeWarpOptions& options);

/// The dynamic program of time_warp.h over given reachable ends.
class SlotSearch {
 public:
  SlotSearch(const Counts& counts, Ends ends);
  /// The ends of the best warp within `reach` (input frames + 1), which must hold one. (input frames + 1)
  std::vector<int> find(FrameDistances& distances, const std::vector<Interval>& reach);

 private:
  void advance_block(FrameDistances& distances, const std::vector<Interval>& reach, int row);
  void advance(const double* distances, const Interval& from, const Interval& to);
  [[nodiscard]] std::vector<int> trace_back(const std::vector<Interval>& reach) const;
  [[nodiscard]] double* at(math::AlignedVector<double>& row, int end) const { return row.data() + pad_ + end; }

  Counts counts_;
  int pad_;                                    // ends beside those of the output, so that no step looks outside
  std::vector<double> factor_, share_;         // by count: what its sum is worth; its unevenness, times tie-break
  std::vector<double> uneven_;                 // share_ times the energy
  math::AlignedVector<double> before_, best_;  // by end: least cost of the frames so far
  math::AlignedVector<double> lengthened_;     // by slot: distances of one input frame
  std::vector<std::uint16_t> row_counts_;
  PackedRows chosen_;
  std::vector<Columns> columns_;
};

/// time_warp, coarse to fine where it must be. Signals and options are checked by the caller (check_time_warp).
class TimeWarpSearch {
 public:
  TimeWarpSearch(int input_frames, const Eigen::Ref<const FrameMatrix>& output, const TimeWarpOptions& options);
  TimeWarp find(const Eigen::Ref<const FrameMatrix>& input);
  /// The best warp near `known`, as `find` looks near a coarser one: never worse than it. For the input last given.
  TimeWarp find_near(const TimeWarp& known);
  [[nodiscard]] bool is_exact() const { return levels_.size() == 1; }
  /// The most even warp.
  [[nodiscard]] TimeWarp even() const;

 private:
  /// A rate at which the warp is searched.
  struct Level {
    int slots;
    std::vector<Interval> reach;
    FrameDistances distances;
  };
  void add_level(int input_frames, const FrameMatrix& output);
  [[nodiscard]] TimeWarp warp_of(const std::vector<int>& path) const;
  [[nodiscard]] int radius() const;

  TimeWarpOptions options_;
  Counts counts_;
  Eigen::RowVectorXd origin_;
  std::vector<Level> levels_;  // finest first
  SlotSearch search_;
};

}  // namespace strut::align::detail
