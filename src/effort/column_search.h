// SPDX-License-Identifier: MIT
// Subsequence dynamic time warping over the columns of a SearchIndex: the query's frames row by row, in blocks of
// columns that threads share. Every block begins as many columns before its own as a match can cover, so that nothing
// that ends in it is cut off, and the result does not depend on where blocks begin.
#pragma once

#include "effort/search_kernels.h"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <strut/effort/fragment_search.h>
#include <strut/math/frame_matrix.h>

namespace strut::effort::detail {

/// Columns that a thread works on at once: with 24 dimensions they fit the second cache.
inline constexpr int kBlockColumns = 8192;

/// A query as the kernels read it: float, filled up to whole kQueryRows.
class SearchQuery {
 public:
  /// Throws InvalidArgument if it is empty, too long, of another width, or not finite.
  SearchQuery(const Eigen::Ref<const FrameMatrix>& query, int dimensions);
  [[nodiscard]] int num_frames() const noexcept { return num_frames_; }
  [[nodiscard]] const float* row(int frame) const {
    return numbers_.data() + static_cast<std::ptrdiff_t>(frame) * dimensions_;
  }

 private:
  int num_frames_, dimensions_;
  std::vector<float> numbers_;
};

/// The cells of the last query frame, by column: their sum of weighted distances and their trace (search_kernels.h).
struct EndCells {
  std::vector<float> cost;
  std::vector<std::int32_t> trace;
};

/// Searches the columns from `first` to before `last`; no match covers another. `start` has a number per column of the
/// index: what it costs to begin a match there, 0 or infinity; null: 0 everywhere. `block` > 0, for tests, is what
/// kBlockColumns is otherwise.
EndCells search_columns(const SearchKernels& kernels, const SearchQuery& query, const SearchIndex& index, int first,
                        int last, const float* start, int block = kBlockColumns);

/// The path's weight: query frames and columns.
inline float path_weight(int query_frames, std::int32_t trace) {
  return static_cast<float>(query_frames + (trace & kSpan));
}

/// Each step at a limit is worth 3 of the path's weight.
inline float share_at_limit(int query_frames, std::int32_t trace) {
  return static_cast<float>(3 * (trace >> kLimitShift)) / path_weight(query_frames, trace);
}

}  // namespace strut::effort::detail
