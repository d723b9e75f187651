// SPDX-License-Identifier: MIT
// Compiled for AVX2 and fused multiply-add where the compiler knows them (src/CMakeLists.txt). It includes nothing
// whose functions other files share, or the linker might take this file's copy for processors that do not have them.
#include "align/warp_kernels.h"

#if defined(__AVX2__) && defined(__FMA__)
#include "align/warp_loops.h"

namespace strut::align::detail {
const WarpKernels* avx2_warp_kernels() noexcept {
  return &kWarpKernels;
}
}  // namespace strut::align::detail
#else
namespace strut::align::detail {
const WarpKernels* avx2_warp_kernels() noexcept {
  return nullptr;
}
}  // namespace strut::align::detail
#endif
