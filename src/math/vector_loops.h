// SPDX-License-Identifier: MIT
// The loops of vector_kernels.h, in plain C++ that compilers turn into vector instructions. Included by one file per
// set of instructions; everything here is local to that file, and no inline function of the standard library is called,
// which another file might share.
//
// Accuracy (tests/math/rotation_arrays_test.cpp holds it): all series are cut where the next term is below half a unit
// of the last place, so errors are a few roundings.
#pragma once

#include "math/vector_kernels.h"

#include <cstdint>
#include <numbers>

#include <strut/math/aligned.h>

namespace strut::math {
namespace {

/// What differs between the precisions: the layout of a number, and how many terms of each series are enough.
/// Arguments: sine and cosine up to pi / 2, arctangent up to tan(pi / 16), exponential up to ln(2) / 2.
template <typename T>
struct Precision;

template <>
struct Precision<float> {
  using Integer = std::int32_t;
  static constexpr int kMantissaBits = 23, kBias = 127;
  static constexpr int kSinTerms = 7, kCosTerms = 7, kAtanTerms = 5, kExpTerms = 8;
  static constexpr float kRounder = 12582912.0F;  // 1.5 * 2^23: adding it leaves no digits behind the point
  static constexpr float kLowest = -87.0F;        // exp of less is no normal number
  // pi and ln 2 in two parts: a multiple of the first by a small whole number is exact.
  static constexpr float kPiHigh = 3.140625F, kLog2High = 0.693145751953125F;
};

template <>
struct Precision<double> {
  using Integer = std::int64_t;
  static constexpr int kMantissaBits = 52, kBias = 1023;
  static constexpr int kSinTerms = 11, kCosTerms = 12, kAtanTerms = 11, kExpTerms = 14;
  static constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52
  static constexpr double kLowest = -708.0;
  static constexpr double kPiHigh = 3.1415926218032837, kLog2High = 0.69314712285995483;
};

template <typename T, int N>
struct Series {
  T terms[N];

  T operator()(T x) const {
    T sum = terms[N - 1];
#pragma GCC unroll 16
    for (int i = N - 2; i >= 0; --i) sum = sum * x + terms[i];
    return sum;
  }
};

/// `term(i)` gives the i-th coefficient.
template <typename T, int N, typename Term>
constexpr Series<T, N> series(Term term) {
  Series<T, N> made{};
  for (int i = 0; i < N; ++i) made.terms[i] = static_cast<T>(term(i));
  return made;
}

constexpr double factorial(int n) {
  double product = 1.0;
  for (int i = 2; i <= n; ++i) product *= i;
  return product;
}

constexpr double alternating(int i) {
  return i % 2 == 0 ? 1.0 : -1.0;
}

// sin(x) / x, cos(x) and atan(x) / x in x^2, exp(x) in x.
template <typename T>
constexpr auto kSinc = series<T, Precision<T>::kSinTerms>([](int i) { return alternating(i) / factorial(2 * i + 1); });
template <typename T>
constexpr auto kCos = series<T, Precision<T>::kCosTerms>([](int i) { return alternating(i) / factorial(2 * i); });
template <typename T>
constexpr auto kAtan = series<T, Precision<T>::kAtanTerms>([](int i) { return alternating(i) / (2 * i + 1); });
template <typename T>
constexpr auto kExp = series<T, Precision<T>::kExpTerms>([](int i) { return 1.0 / factorial(i); });

inline float root(float x) {
  return __builtin_sqrtf(x);
}
inline double root(double x) {
  return __builtin_sqrt(x);
}

/// The nearest whole number, up to 2^22 (2^51).
template <typename T>
inline T rounded(T x) {
  return (x + Precision<T>::kRounder) - Precision<T>::kRounder;
}

template <typename T>
void exp_maps(int count, int stride, const T* __restrict vectors, T* __restrict rotations) {
  constexpr T kPiLow = static_cast<T>(std::numbers::pi - static_cast<double>(Precision<T>::kPiHigh));
  const T* x = vectors;
  const T* y = vectors + stride;
  const T* z = vectors + 2 * stride;
  for (int i = 0; i < count; ++i) {
    const T half = T(0.5) * root(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    // sin and cos of half - turns pi; an odd number of half turns changes their signs.
    const T turns = rounded(half * std::numbers::inv_pi_v<T>);
    const T rest = (half - turns * Precision<T>::kPiHigh) - turns * kPiLow;
    const T odd = turns - T(2) * rounded(T(0.5) * turns - T(0.25));
    const T sign = T(1) - T(2) * odd;
    const T share = turns == T(0) ? T(1) : rest / (turns == T(0) ? T(1) : half);
    const T scale = T(0.5) * sign * share * kSinc<T>(rest * rest);
    rotations[i] = scale * x[i];
    rotations[i + stride] = scale * y[i];
    rotations[i + 2 * stride] = scale * z[i];
    rotations[i + 3 * stride] = sign * kCos<T>(rest * rest);
  }
}

template <typename T>
void log_maps(int count, int stride, const T* __restrict rotations, T* __restrict vectors) {
  const T* x = rotations;
  const T* y = rotations + stride;
  const T* z = rotations + 2 * stride;
  const T* w = rotations + 3 * stride;
  for (int i = 0; i < count; ++i) {
    const T sign = w[i] < T(0) ? T(-1) : T(1);
    const T cosine = sign * w[i];
    const T squared_sine = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    // tan of a half, a quarter and an eighth of the half angle; nothing is divided by the sine, which may be zero.
    const T first = root(squared_sine + cosine * cosine) + cosine;
    const T half = root(squared_sine) / first;
    const T second = T(1) + root(T(1) + half * half);
    const T quarter = half / second;
    const T third = T(1) + root(T(1) + quarter * quarter);
    const T eighth = quarter / third;
    const T scale = sign * T(16) * kAtan<T>(eighth * eighth) / (first * second * third);
    vectors[i] = scale * x[i];
    vectors[i + stride] = scale * y[i];
    vectors[i + 2 * stride] = scale * z[i];
  }
}

template <typename T>
void multiply_rotations(int count, int stride, const T* __restrict a, const T* __restrict b, T* __restrict product) {
  const int y = stride, z = 2 * stride, w = 3 * stride;
  for (int i = 0; i < count; ++i) {
    product[i] = a[i + w] * b[i] + a[i] * b[i + w] + a[i + y] * b[i + z] - a[i + z] * b[i + y];
    product[i + y] = a[i + w] * b[i + y] - a[i] * b[i + z] + a[i + y] * b[i + w] + a[i + z] * b[i];
    product[i + z] = a[i + w] * b[i + z] + a[i] * b[i + y] - a[i + y] * b[i] + a[i + z] * b[i + w];
    product[i + w] = a[i + w] * b[i + w] - a[i] * b[i] - a[i + y] * b[i + y] - a[i + z] * b[i + z];
  }
}

template <typename T>
void turn_vectors(int count, int stride, const T* __restrict matrices, const T* __restrict vectors,
                  T* __restrict turned) {
  for (int row = 0; row < 3; ++row) {
    const T* m = matrices + 3 * row * stride;
    T* __restrict result = turned + row * stride;
    for (int i = 0; i < count; ++i) {
      result[i] = m[i] * vectors[i] + m[i + stride] * vectors[i + stride] + m[i + 2 * stride] * vectors[i + 2 * stride];
    }
  }
}

template <typename T>
inline T exponential(T x) {
  using Integer = typename Precision<T>::Integer;
  constexpr T kLog2Low = static_cast<T>(std::numbers::ln2 - static_cast<double>(Precision<T>::kLog2High));
  const T bounded = x < Precision<T>::kLowest ? Precision<T>::kLowest : x;
  const T shifted = bounded * std::numbers::log2e_v<T> + Precision<T>::kRounder;
  const T power = shifted - Precision<T>::kRounder;
  const T rest = (bounded - power * Precision<T>::kLog2High) - power * kLog2Low;
  // The rounder's last bits hold the whole number; as an exponent it makes 2^power.
  const Integer exponent = __builtin_bit_cast(Integer, shifted) + Precision<T>::kBias;
  const auto two_to_power = __builtin_bit_cast(T, static_cast<Integer>(exponent << Precision<T>::kMantissaBits));
  return kExp<T>(rest) * two_to_power;
}

template <typename T>
T exponentials(int count, T offset, T scale, T* __restrict x) {
  T sums[kLanes] = {};
  for (int i = 0; i < count; ++i) x[i] = exponential((offset - x[i]) * scale);
  for (int i = 0; i < count; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) sums[lane] += x[i + lane];
  }
  T sum = T(0);
  for (const T lane : sums) sum += lane;
  return sum;
}

template <typename T>
T smallest(int count, const T* __restrict x) {
  T least[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) least[lane] = x[lane];
  for (int i = kLanes; i < count; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) least[lane] = x[i + lane] < least[lane] ? x[i + lane] : least[lane];
  }
  T all = least[0];
  for (const T lane : least) all = lane < all ? lane : all;
  return all;
}

template <typename T>
void multiply(int rows, int cols, const T* __restrict matrix, const T* __restrict x, T* __restrict y) {
  for (int row = 0; row < rows; row += kTileRows) {
    T even[kTileRows] = {};
    T odd[kTileRows] = {};  // two sums, so that one addition need not wait for the one before
    int col = 0;
    for (; col + 1 < cols; col += 2, matrix += 2 * kTileRows) {
      for (int lane = 0; lane < kTileRows; ++lane) even[lane] += matrix[lane] * x[col];
      for (int lane = 0; lane < kTileRows; ++lane) odd[lane] += matrix[kTileRows + lane] * x[col + 1];
    }
    if (col < cols) {
      for (int lane = 0; lane < kTileRows; ++lane) even[lane] += matrix[lane] * x[col];
      matrix += kTileRows;
    }
    for (int lane = 0; lane < kTileRows; ++lane) y[row + lane] = even[lane] + odd[lane];
  }
}

template <typename T>
void squared_distances(int rows, int cols, const T* __restrict matrix, const T* __restrict x, bool add,
                       T* __restrict y) {
  for (int row = 0; row < rows; row += kTileRows) {
    T sums[kTileRows] = {};
    for (int col = 0; col < cols; ++col, matrix += kTileRows) {
      const T value = x[col];
      for (int lane = 0; lane < kTileRows; ++lane) {
        const T difference = matrix[lane] - value;
        sums[lane] += difference * difference;
      }
    }
    for (int lane = 0; lane < kTileRows; ++lane) y[row + lane] = sums[lane] + (add ? y[row + lane] : T(0));
  }
}

/// kLanes numbers as the compiler's own vectors, where its vectorizer does not see that short loops over few columns
/// are worth it. Loaded through memory, so that they may stand anywhere.
template <typename T>
struct Lanes {
  static constexpr int kBytes = 32;  // of a vector of AVX2
  static constexpr int kPer = kBytes / static_cast<int>(sizeof(T));
  static constexpr int kVectors = kLanes / kPer;
  typedef T Vector __attribute__((vector_size(kBytes)));  // NOLINT(modernize-use-using): g++ wants it so
  Vector numbers[kVectors];

  void add_product(const T* __restrict a, const T* __restrict b) {
#pragma GCC unroll 2
    for (int i = 0; i < kVectors; ++i) {
      Vector x, y;
      __builtin_memcpy(&x, a + i * kPer, kBytes);
      __builtin_memcpy(&y, b + i * kPer, kBytes);
      numbers[i] += x * y;
    }
  }
  void store(T* __restrict to) const {
#pragma GCC unroll 2
    for (int i = 0; i < kVectors; ++i) __builtin_memcpy(to + i * kPer, &numbers[i], kBytes);
  }
};

template <typename T>
inline const T* row_of_systems(int states, int inputs, const T* __restrict matrix, const T* __restrict state,
                               const T* __restrict input, const int* __restrict input_at, T* __restrict result) {
  Lanes<T> sums{};
  for (int col = 0; col < states; ++col, matrix += kLanes) sums.add_product(matrix, state + col * kLanes);
  for (int col = 0; col < inputs; ++col, matrix += kLanes) sums.add_product(matrix, input + input_at[col]);
  sums.store(result);
  return matrix;
}

template <typename T>
void step_systems(int states, int inputs, int outputs, const T* __restrict matrix, const T* __restrict input,
                  const int* __restrict input_at, const T* __restrict state, T* __restrict next, T* __restrict output,
                  const int* __restrict output_at) {
  for (int row = 0; row < states; ++row)
    matrix = row_of_systems(states, inputs, matrix, state, input, input_at, next + row * kLanes);
  for (int row = 0; row < outputs; ++row)
    matrix = row_of_systems(states, inputs, matrix, state, input, input_at, output + output_at[row]);
}

template <typename T>
constexpr VectorKernels<T> kKernels = {exp_maps<T>,     log_maps<T>,          multiply_rotations<T>,
                                       turn_vectors<T>, exponentials<T>,      smallest<T>,
                                       multiply<T>,     squared_distances<T>, step_systems<T>};

}  // namespace
}  // namespace strut::math
