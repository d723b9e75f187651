// SPDX-License-Identifier: MIT
// Compiled for AVX2 and fused multiply-add where the compiler knows them (src/CMakeLists.txt). It includes nothing
// whose functions other files share, or the linker might take this file's copy for processors that do not have them.
#include "math/vector_kernels_avx2.h"

#if defined(__AVX2__) && defined(__FMA__)
#include "math/vector_loops.h"

namespace strut::math {
template <>
const VectorKernels<float>* avx2_kernels() noexcept {
  return &kKernels<float>;
}
template <>
const VectorKernels<double>* avx2_kernels() noexcept {
  return &kKernels<double>;
}
}  // namespace strut::math
#else
namespace strut::math {
template <>
const VectorKernels<float>* avx2_kernels() noexcept {
  return nullptr;
}
template <>
const VectorKernels<double>* avx2_kernels() noexcept {
  return nullptr;
}
}  // namespace strut::math
#endif
