// SPDX-License-Identifier: MIT
// The loops of warp_kernels.h. Included by one file per set of instructions; everything here is local to that file, and
// no inline function of the standard library is called, which another file might share.
#pragma once

#include "align/warp_kernels.h"

namespace strut::align::detail {
namespace {

// As many numbers as a register holds, and the rows of a group of frames whose sums fit the registers beside.
#ifdef __AVX2__
constexpr int kBytes = 32, kRows = 4;
#else
constexpr int kBytes = 16, kRows = 2;
#endif
constexpr int kWide = kBytes / 8;
constexpr int kVectors = 8 / kWide;  // in a tile, and in what is decided at once

// The compiler's own vectors, loaded through memory, so that they may stand anywhere.
typedef double Numbers __attribute__((vector_size(kBytes)));         // NOLINT(modernize-use-using): g++ wants it so
typedef std::int64_t Integers __attribute__((vector_size(kBytes)));  // NOLINT(modernize-use-using)
typedef std::uint16_t ShortNumbers __attribute__((vector_size(kBytes / 4)));  // NOLINT(modernize-use-using)

constexpr double kInfinity = __builtin_huge_val();

inline Numbers load(const double* from) {
  Numbers numbers;
  __builtin_memcpy(&numbers, from, sizeof(numbers));
  return numbers;
}

inline void store(const Numbers& numbers, double* to) {
  __builtin_memcpy(to, &numbers, sizeof(numbers));
}

inline void store(const Integers& numbers, std::uint16_t* to) {
  const ShortNumbers narrow = __builtin_convertvector(numbers, ShortNumbers);
  __builtin_memcpy(to, &narrow, sizeof(narrow));
}

inline void tile_distances(int dofs, const double* __restrict input, const double* __restrict input_norms,
                           const double* __restrict output, const double* __restrict output_norms,
                           double* __restrict distances, std::ptrdiff_t stride) {
  Numbers sums[kRows][kVectors] = {};
  for (int d = 0; d < dofs; ++d, output += kTileFrames) {
#pragma GCC unroll 4
    for (int i = 0; i < kRows; ++i) {
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) sums[i][v] += input[i * dofs + d] * load(output + v * kWide);
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < kRows; ++i) {
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) {
      // Rounding may take equal frames a little below zero.
      const Numbers distance = (load(output_norms + v * kWide) + input_norms[i]) - 2.0 * sums[i][v], zero = {};
      store(distance > zero ? distance : zero, distances + i * stride + v * kWide);
    }
  }
}

void squared_distances(int dofs, int tiles, const double* input, const double* input_norms, const double* output,
                       const double* output_norms, double* distances, std::ptrdiff_t stride) {
  for (int tile = 0; tile < tiles; ++tile) {
    for (int i = 0; i < kGroupFrames; i += kRows) {
      tile_distances(dofs, input + i * dofs, input_norms + i, output, output_norms, distances + i * stride, stride);
    }
    output += dofs * kTileFrames;
    output_norms += kTileFrames;
    distances += kTileFrames;
  }
}

/// The least of what was offered so far, and which it was.
struct Choice {
  Numbers cost;
  Integers which;

  explicit Choice(const Numbers& first) : cost(first), which{} {}
  void offer(const Numbers& candidate, std::int64_t number) {
    const Integers is_less = candidate < cost;
    which = is_less ? number - Integers{} : which;
    cost = is_less ? candidate : cost;
  }
};

template <int kTimes>
void lengthen_by(int count, int times, const double* __restrict numbers, double* __restrict to) {
  const int step = kTimes > 0 ? kTimes : times;
  for (int i = 0; i < count; ++i) {
    for (int part = 0; part < step; ++part) to[i * step + part] = numbers[i];
  }
}

void lengthen(int count, int times, const double* numbers, double* to) {
  if (times == 2) return lengthen_by<2>(count, times, numbers, to);
  return lengthen_by<0>(count, times, numbers, to);
}

template <int kMost>
void choose_up_to(int width, int least, int most, const double* __restrict factor, const double* __restrict uneven,
                  const double* __restrict before, const double* __restrict distance, double* __restrict best,
                  std::uint16_t* __restrict counts) {
  const int first = kMost > 0 ? 1 : least, last = kMost > 0 ? kMost : most;
  for (int x = 0; x < width; x += kWide) {
    Numbers sum = {};
    for (int r = 1; r < first; ++r) sum += load(distance + x - r);
    Choice choice(Numbers{} + kInfinity);
#pragma GCC unroll 4
    for (int r = first; r <= last; ++r) {
      sum += load(distance + x - r);
      choice.offer(load(before + x - r) + (sum * factor[r] + uneven[r]), r - first);
    }
    store(choice.cost, best + x);
    store(choice.which, counts + x);
  }
}

void choose_counts(int width, int least, int most, const double* factor, const double* uneven, const double* before,
                   const double* distance, double* best, std::uint16_t* counts) {
  // The paper's form with a slope limit of 2 is the usual one: the compiler may lay its four steps out.
  const auto choose = least == 1 && most == 4 ? choose_up_to<4> : choose_up_to<0>;
  choose(width, least, most, factor, uneven, before, distance, best, counts);
}

void pack(int count, int bits, const std::uint16_t* __restrict numbers, std::uint8_t* __restrict packed) {
  if (bits >= 8) {
    for (int i = 0; i < count; ++i) {
      for (int shift = 0; shift < bits; shift += 8) *packed++ = static_cast<std::uint8_t>(numbers[i] >> shift);
    }
    return;
  }
  const int shift = 16 - bits;
  for (int i = 0; i < count; i += 4) {
    const std::uint16_t* four = numbers + i;
    const std::uint64_t apart = static_cast<std::uint64_t>(four[0]) | static_cast<std::uint64_t>(four[1]) << 16U |
                                static_cast<std::uint64_t>(four[2]) << 32U | static_cast<std::uint64_t>(four[3]) << 48U;
    // Each number moves down to where the one before it ends; above stays what is cut off.
    const std::uint64_t joined = apart | apart >> shift | apart >> 2 * shift | apart >> 3 * shift;
    for (int from = 0; from < 4 * bits; from += 8) *packed++ = static_cast<std::uint8_t>(joined >> from);
  }
}

void step_type_iii(int width, const double* __restrict one, const double* __restrict two,
                   const double* __restrict distance, double* __restrict best, std::uint16_t* __restrict steps) {
  for (int j = 0; j < width; j += kWide) {
    const Numbers d = load(distance + j), d3 = 3.0 * d;
    Choice choice(load(one + j - 1) + 2.0 * d);
    choice.offer(load(two + j - 1) + d3, 1);
    choice.offer(load(one + j - 2) + d3, 2);
    store(choice.cost, best + j);
    store(choice.which, steps + j);
  }
}

void step_type_i(int width, const double* __restrict one, const double* __restrict distance, double* __restrict best,
                 std::uint16_t* __restrict steps) {
  for (int j = 0; j < width; j += kWide) {
    const Numbers d = load(distance + j);
    Choice choice(load(one + j - 1) + 2.0 * d);
    choice.offer(load(one + j) + d, 1);
    store(choice.cost, best + j);
    store(choice.which, steps + j);
  }
}

void eliminate(int dofs, const Elimination& with, const double* __restrict u, const double* __restrict v,
               const double* __restrict before, const double* __restrict before_a, const double* __restrict before_b,
               double* __restrict now, double* __restrict a, double* __restrict b) {
  const double f = with.beside_a, g = with.beside_b;
  double* __restrict aa_now = now;
  double* __restrict ab_now = now + dofs;
  double* __restrict bb_now = now + 2 * dofs;
  for (int d = 0; d < dofs; ++d) {
    const double aa = with.weight * u[d] * u[d] + with.diagonal_a - f * f * before[d];
    const double ab = with.weight * u[d] - f * g * before[d + dofs];
    const double bb = with.weight + with.diagonal_b - g * g * before[d + 2 * dofs];
    const double right_a = u[d] * v[d] + with.ridge + f * before_a[d];
    const double right_b = v[d] + g * before_b[d];
    const double inverse = 1.0 / (aa * bb - ab * ab);
    const double inverse_aa = bb * inverse, inverse_ab = -ab * inverse, inverse_bb = aa * inverse;
    aa_now[d] = inverse_aa;
    ab_now[d] = inverse_ab;
    bb_now[d] = inverse_bb;
    a[d] = inverse_aa * right_a + inverse_ab * right_b;
    b[d] = inverse_ab * right_a + inverse_bb * right_b;
  }
}

void substitute(int dofs, double beside_a, double beside_b, const double* __restrict kept,
                const double* __restrict next_a, const double* __restrict next_b, double* __restrict a,
                double* __restrict b) {
  for (int d = 0; d < dofs; ++d) {
    const double right_a = beside_a * next_a[d], right_b = beside_b * next_b[d];
    a[d] += kept[d] * right_a + kept[d + dofs] * right_b;
    b[d] += kept[d + dofs] * right_a + kept[d + 2 * dofs] * right_b;
  }
}

void add_scaled(int count, double scale, const double* __restrict x, double* __restrict y) {
  for (int i = 0; i < count; ++i) y[i] += scale * x[i];
}

void add_squared_differences(int count, double scale, const double* __restrict x, const double* __restrict y,
                             double* __restrict sum) {
  for (int i = 0; i < count; ++i) sum[i] += scale * ((x[i] - y[i]) * (x[i] - y[i]));
}

void warp(int count, const double* __restrict a, const double* __restrict u, const double* __restrict b,
          double* __restrict p) {
  for (int i = 0; i < count; ++i) p[i] = a[i] * u[i] + b[i];
}

constexpr WarpKernels kWarpKernels = {
    squared_distances, lengthen,   choose_counts,           pack, step_type_iii, step_type_i, eliminate,
    substitute,        add_scaled, add_squared_differences, warp};

}  // namespace
}  // namespace strut::align::detail
