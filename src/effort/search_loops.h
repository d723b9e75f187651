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
    const Integers diagonal = load(trace_one + j - 1);
    Integers best_trace = (diagonal & ~kStep) + 1;

    const Numbers along_recording = load(one + j - 2) + (beside + beside) + here;
    const Integers last = load(trace_one + j - 2);
    // A step at a limit counts if the one before was the same: one alone only rounds to whole frames.
    const Integers recording_trace =
        (last & ~kStep) + ((last & kAlongRecording) << (kLimitShift - kSpanBits)) + (kAlongRecording + 2);
    const Integers by_recording = along_recording < best;
    best = by_recording ? along_recording : best;
    best_trace = by_recording ? recording_trace : best_trace;

    const Numbers along_query = load(two + j - 1) + (below + below) + here;
    const Integers before_last = load(trace_two + j - 1);
    const Integers query_trace =
        (before_last & ~kStep) + ((before_last & kAlongQuery) << (kLimitShift - kSpanBits - 1)) + (kAlongQuery + 1);
    const Integers by_query = along_query < best;
    store(by_query ? along_query : best, cost + j);
    store(by_query ? query_trace : best_trace, trace + j);
  }
}

constexpr SearchKernels kSearchKernels = {distances, step};

}  // namespace
}  // namespace strut::effort::detail
