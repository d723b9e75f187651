// SPDX-License-Identifier: MIT
// The kernels for every processor, and the choice between the two.
#include "effort/search_loops.h"
#include "math/vector_kernels.h"

namespace strut::effort::detail {

const SearchKernels& portable_search_kernels() noexcept {
  return kSearchKernels;
}

const SearchKernels& search_kernels() {
  static const SearchKernels& chosen =
      avx2_search_kernels() != nullptr && math::has_avx2() ? *avx2_search_kernels() : kSearchKernels;
  return chosen;
}

}  // namespace strut::effort::detail
