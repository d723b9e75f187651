// SPDX-License-Identifier: MIT
// The loops of search_kernels.h. Included by one file per set of instructions; everything here is local to that file,
// and no inline function of the standard library is called, which another file might share.
#pragma once

#include "effort/search_kernels.h"

namespace strut::effort::detail {
namespace {

// As many numbers as a register holds, and the query frames whose sums fit the registers beside.
#ifdef __AVX2__
constexpr int kBytes = 32, kRows = 4;
#else
constexpr int kBytes = 16, kRows = 2;
#endif
constexpr int kWide = kBytes / 4;
constexpr int kVectors = kTileColumns / kWide;

// The compiler's own vectors, loaded through memory, so that they may stand anywhere.
typedef float Numbers __attribute__((vector_size(kBytes)));          // NOLINT(modernize-use-using): g++ wants it so
typedef std::int32_t Integers __attribute__((vector_size(kBytes)));  // NOLINT(modernize-use-using)

inline Numbers load(const float* from) {
  Numbers numbers;
  __builtin_memcpy(&numbers, from, sizeof(numbers));
  return numbers;
}

inline Integers load(const std::int32_t* from) {
  Integers numbers;
  __builtin_memcpy(&numbers, from, sizeof(numbers));
  return numbers;
}

inline void store(const Numbers& numbers, float* to) {
  __builtin_memcpy(to, &numbers, sizeof(numbers));
}

inline void store(const Integers& numbers, std::int32_t* to) {
  __builtin_memcpy(to, &numbers, sizeof(numbers));
}

inline void store_roots(const Numbers& squares, float* to) {
  for (int k = 0; k < kWide; ++k) to[k] = __builtin_sqrtf(squares[k]);
}

inline void tile_distances(int dimensions, const float* __restrict query, const float* __restrict columns,
                           float* __restrict distances, std::ptrdiff_t stride) {
  Numbers sums[kRows][kVectors] = {};
  for (int d = 0; d < dimensions; ++d, columns += kTileColumns) {
#pragma GCC unroll 4
    for (int i = 0; i < kRows; ++i) {
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Numbers apart = load(columns + v * kWide) - query[i * dimensions + d];
        sums[i][v] += apart * apart;
      }
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < kRows; ++i) {
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) store_roots(sums[i][v], distances + i * stride + v * kWide);
  }
}

void distances(int dimensions, int tiles, const float* query, const float* columns, float* to, std::ptrdiff_t stride) {
  for (int tile = 0; tile < tiles; ++tile) {
    for (int i = 0; i < kQueryRows; i += kRows) {
      tile_distances(dimensions, query + i * dimensions, columns, to + i * stride, stride);
    }
    columns += static_cast<std::ptrdiff_t>(dimensions) * kTileColumns;
    to += kTileColumns;
  }
}

inline Integers without_runs(const Integers& trace) {
  return trace & ~(kColumnRun | kQueryRun);
}

// A full run and one more carry into the next higher bit: the lowest of the other run, or of the count.
inline Integers after_two_columns(const Integers& trace) {
  const Integers run = trace & kColumnRun, carry = (run + kTwoColumns) & kTwoQueryFrames;
  return (without_runs(trace) + 2) + (((run << 1) & kColumnRun) | kTwoColumns) + (carry << (kLimitShift - 16));
}

inline Integers after_two_query_frames(const Integers& trace) {
  const Integers run = trace & kQueryRun, carry = (run + kTwoQueryFrames) & (1 << kLimitShift);
  return (without_runs(trace) + 1) + (((run << 1) & kQueryRun) | kTwoQueryFrames) + carry;
}

void step(int width, const float* __restrict distance, const float* __restrict distance_before, const CellRow& before,
          const CellRow& two_before, const CellRow& now) {
  const float* __restrict one = before.cost;
  const float* __restrict two = two_before.cost;
  const std::int32_t* __restrict trace_one = before.trace;
  const std::int32_t* __restrict trace_two = two_before.trace;
  float* __restrict cost = now.cost;
  std::int32_t* __restrict trace = now.trace;
  for (int j = 0; j < width; j += kWide) {
    const Numbers here = load(distance + j), beside = load(distance + j - 1), below = load(distance_before + j);
    Numbers best = load(one + j - 1) + (here + here);
    Integers best_trace = without_runs(load(trace_one + j - 1)) + 1;

    const Numbers two_columns = load(one + j - 2) + (beside + beside) + here;
    const Integers by_columns = two_columns < best;
    best = by_columns ? two_columns : best;
    best_trace = by_columns ? after_two_columns(load(trace_one + j - 2)) : best_trace;

    const Numbers two_frames = load(two + j - 1) + (below + below) + here;
    const Integers by_frames = two_frames < best;
    store(by_frames ? two_frames : best, cost + j);
    store(by_frames ? after_two_query_frames(load(trace_two + j - 1)) : best_trace, trace + j);
  }
}

constexpr SearchKernels kSearchKernels = {distances, step};

}  // namespace
}  // namespace strut::effort::detail
