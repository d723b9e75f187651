// SPDX-License-Identifier: MIT
// The inner loops of alignment, for the instructions that this processor has: compiled once for every x86-64 (or
// whatever else the compiler aims at) and once for AVX2 with fused multiply-add, as math/vector_kernels.h does for the
// runtime. The two differ in the last digits, one processor always gives the same.
#pragma once

#include <cstddef>
#include <cstdint>

namespace strut::align::detail {

inline constexpr int kTileFrames = 8;   ///< output frames of a tile: degree of freedom by degree of freedom, 8 numbers
inline constexpr int kGroupFrames = 4;  ///< input frames whose distances are computed at once
inline constexpr int kSlotLanes = 8;    ///< slots or cells decided at once

/// Numbers per degree of freedom that elimination keeps of a frame, beside a and b: the inverse block aa, ab, bb.
inline constexpr int kEliminated = 3;

/// What the elimination of a frame's degrees of freedom needs beside its row of numbers (space_warp.cpp).
struct Elimination {
  double weight;              ///< of the frame
  double diagonal_a;          ///< what smoothness and ridge put on the diagonal
  double diagonal_b;          ///< the same for b
  double beside_a, beside_b;  ///< the smoothness that joins it to the frame before
  double ridge;               ///< towards a = 1
};

/// Arrays do not overlap.
struct WarpKernels {
  /// distances[i * stride + j] = max(0, |p_i|^2 + |q_j|^2 - 2 p_i . q_j) of kGroupFrames input frames p (row by row,
  /// `dofs` long) and `tiles` * kTileFrames output frames q.
  void (*squared_distances)(int dofs, int tiles, const double* input, const double* input_norms, const double* output,
                            const double* output_norms, double* distances, std::ptrdiff_t stride);
  /// Every number `times` times.
  void (*lengthen)(int count, int times, const double* numbers, double* to);
  /// For the ends x = 0 ... width - 1 (rounded up to kSlotLanes): the count r in least ... most with the least
  ///   before[x - r] + factor[r] * (sum of distance[x - r ... x - 1]) + uneven[r],
  /// of equals the smallest; best[x] is that, counts[x] is r - least.
  void (*choose_counts)(int width, int least, int most, const double* factor, const double* uneven,
                        const double* before, const double* distance, double* best, std::uint16_t* counts);
  /// Packs `count` numbers (readable up to the next multiple of 4) of `bits` (2, 4, 8 or 16) bits each, first lowest.
  void (*pack)(int count, int bits, const std::uint16_t* numbers, std::uint8_t* packed);
  /// One row of dynamic time warping: best[j] = the least of one[j - 1] + 2 d[j], and two[j - 1] + 3 d[j] and
  /// one[j - 2] + 3 d[j] (Type III) or one[j] + d[j] (Type I; best[j - 1] + d[j] is left to be tried); steps[j] = 0, 1
  /// or 2 says which.
  void (*step_type_iii)(int width, const double* one, const double* two, const double* distance, double* best,
                        std::uint16_t* steps);
  void (*step_type_i)(int width, const double* one, const double* distance, double* best, std::uint16_t* steps);
  /// Eliminates a frame: `before` and `now` are kEliminated rows of `dofs` numbers, a and b what they are as far as the
  /// frames up to this one determine them, u the input, v the sum of what it is matched with (times its weight).
  void (*eliminate)(int dofs, const Elimination& with, const double* u, const double* v, const double* before,
                    const double* before_a, const double* before_b, double* now, double* a, double* b);
  /// Adds to a and b of a frame what the next frame's say, by what elimination kept.
  void (*substitute)(int dofs, double beside_a, double beside_b, const double* kept, const double* next_a,
                     const double* next_b, double* a, double* b);
  /// y += scale x.
  void (*add_scaled)(int count, double scale, const double* x, double* y);
  /// sum += scale (x - y)^2.
  void (*add_squared_differences)(int count, double scale, const double* x, const double* y, double* sum);
  /// p = a u + b.
  void (*warp)(int count, const double* a, const double* u, const double* b, double* p);
};

/// The kernels for this processor.
const WarpKernels& warp_kernels();

/// Those compiled for AVX2 with fused multiply-add; null where the compiler aims at another processor.
const WarpKernels* avx2_warp_kernels() noexcept;

/// Those for every processor: for tests, which hold them against the others.
const WarpKernels& portable_warp_kernels() noexcept;

}  // namespace strut::align::detail
