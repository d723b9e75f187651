// SPDX-License-Identifier: MIT
// Compiled for AVX2 where the compiler knows it (src/CMakeLists.txt). It includes nothing whose functions other files
// share, or the linker might take this file's copy for processors that do not have it.
#include "effort/search_kernels.h"

#ifdef __AVX2__
#include "effort/search_loops.h"

namespace strut::effort::detail {
const SearchKernels* avx2_search_kernels() noexcept {
  return &kSearchKernels;
}
}  // namespace strut::effort::detail
#else
namespace strut::effort::detail {
const SearchKernels* avx2_search_kernels() noexcept {
  return nullptr;
}
}  // namespace strut::effort::detail
#endif
