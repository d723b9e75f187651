// SPDX-License-Identifier: MIT
// The kernels for every processor, and the choice between the two.
#include "math/vector_kernels_avx2.h"
#include "math/vector_loops.h"

namespace strut::math {
bool has_avx2() noexcept {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") > 0 && __builtin_cpu_supports("fma") > 0;
#else
  return false;
#endif
}

namespace {

template <typename T>
const VectorKernels<T>& choose() {
  const VectorKernels<T>* avx2 = avx2_kernels<T>();
  return avx2 != nullptr && has_avx2() ? *avx2 : kKernels<T>;
}

}  // namespace

template <>
const VectorKernels<float>& vector_kernels() {
  static const VectorKernels<float>& chosen = choose<float>();
  return chosen;
}

template <>
const VectorKernels<double>& vector_kernels() {
  static const VectorKernels<double>& chosen = choose<double>();
  return chosen;
}

}  // namespace strut::math
