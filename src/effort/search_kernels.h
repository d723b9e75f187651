// SPDX-License-Identifier: MIT
// The inner loops of the search for fragments, for the instructions that this processor has: compiled once for every
// x86-64 (or whatever else the compiler aims at) and once for AVX2, as align/warp_kernels.h does for alignment. No
// product is fused with a sum (src/CMakeLists.txt), so both, and any plain program that does the same operations in the
// same order in float, agree to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace strut::effort::detail {

inline constexpr int kTileColumns = 16;  ///< columns of a tile: dimension by dimension, 16 numbers
inline constexpr int kQueryRows = 4;     ///< query frames whose distances are computed at once

// What is carried with a cell beside its cost, in one number: how many columns its path covers, which of its last three
// steps took two columns, which took two query frames (a run of either ends with any other step, so one of the two is
// empty), and how many steps have followed three of their own kind.
inline constexpr std::int32_t kSpan = (1 << 13) - 1;            ///< mask of the columns covered: 2 * 4096 - 1 at most
inline constexpr std::int32_t kTwoColumns = 1 << 13;            ///< the last step took two columns
inline constexpr std::int32_t kColumnRun = 7 * kTwoColumns;     ///< mask: so did the two before
inline constexpr std::int32_t kTwoQueryFrames = 1 << 16;        ///< the last step took two query frames
inline constexpr std::int32_t kQueryRun = 7 * kTwoQueryFrames;  ///< mask: so did the two before
inline constexpr int kLimitShift = 19;                          ///< where the count of steps at a limit begins

/// A row of cells, each array with kTileColumns numbers readable before its first: infinite costs, any trace.
struct CellRow {
  float* cost;
  std::int32_t* trace;
};

/// Arrays do not overlap.
struct SearchKernels {
  /// distances[i * stride + j] = sqrt(sum over dimensions d, in their order, of (x_jd - y_id)^2) of kQueryRows query
  /// frames y (row by row) and the columns x of `tiles` tiles.
  void (*distances)(int dimensions, int tiles, const float* query, const float* columns, float* distances,
                    std::ptrdiff_t stride);
  /// The cells of a query frame from those of the two before: `distance` and `distance_before` are the distances of
  /// this query frame and of the one before, readable from one before the first. `width` is a multiple of kTileColumns.
  void (*step)(int width, const float* distance, const float* distance_before, const CellRow& before,
               const CellRow& two_before, const CellRow& now);
};

/// The kernels for this processor.
const SearchKernels& search_kernels();

/// Those compiled for AVX2; null where the compiler aims at another processor.
const SearchKernels* avx2_search_kernels() noexcept;

/// Those for every processor: for tests, which hold both against a plain program.
const SearchKernels& portable_search_kernels() noexcept;

}  // namespace strut::effort::detail
