// SPDX-License-Identifier: MIT
// The inner loops of the runtime, over arrays of numbers, for the instructions that this processor has: compiled once
// for every x86-64 (or whatever else the compiler aims at) and once for AVX2 with fused multiply-add. The two differ in
// the last digits, one processor always gives the same.
#pragma once

namespace strut::math {

/// Counts are multiples of kLanes, rows of tiled matrices (tiled_matrix.h) of kTileRows; arrays do not overlap unless
/// said.
template <typename T>
struct VectorKernels {
  /// Exponential maps (rotation.h) of `count` rotation vectors, given as three planes x, y, z `stride` apart, as four
  /// planes x, y, z, w.
  void (*exp_maps)(int count, int stride, const T* vectors, T* rotations);
  /// Logarithm maps, the shortest rotations, of quaternions of any length but zero.
  void (*log_maps)(int count, int stride, const T* rotations, T* vectors);
  /// Products a b of quaternions, 4 planes each.
  void (*multiply_rotations)(int count, int stride, const T* a, const T* b, T* product);
  /// `matrices` (9 planes, row by row) times `vectors` (3 planes).
  void (*turn_vectors)(int count, int stride, const T* matrices, const T* vectors, T* turned);
  /// x = exp((offset - x) * scale) where offset <= x, scale > 0; gives the sum.
  T (*exponentials)(int count, T offset, T scale, T* x);
  /// The smallest of x.
  T (*smallest)(int count, const T* x);
  /// y = matrix x: `rows` x `cols`, tiled.
  void (*multiply)(int rows, int cols, const T* matrix, const T* x, T* y);
  /// y += (or =, if not `add`) squared distances of x (`cols`) to the rows of `matrix`.
  void (*squared_distances)(int rows, int cols, const T* matrix, const T* x, bool add, T* y);
  /// kLanes linear systems at once: `matrix` holds, row by row of [A B; C D] and lane by lane, states + inputs columns
  /// in states + outputs rows; the lanes of input i begin at input[input_at[i]], of output i at output[output_at[i]].
  void (*step_systems)(int states, int inputs, int outputs, const T* matrix, const T* input, const int* input_at,
                       const T* state, T* next, T* output, const int* output_at);
};

/// Whether this processor has AVX2 and fused multiply-add.
bool has_avx2() noexcept;

/// The kernels for this processor. T is float or double.
template <typename T>
const VectorKernels<T>& vector_kernels();

}  // namespace strut::math
