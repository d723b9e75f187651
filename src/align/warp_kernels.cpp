// SPDX-License-Identifier: MIT
// The kernels for every processor, and the choice between the two.
#include "align/warp_loops.h"
#include "math/vector_kernels.h"

namespace strut::align::detail {

const WarpKernels& portable_warp_kernels() noexcept {
  return kWarpKernels;
}

const WarpKernels& warp_kernels() {
  static const WarpKernels& chosen =
      avx2_warp_kernels() != nullptr && math::has_avx2() ? *avx2_warp_kernels() : kWarpKernels;
  return chosen;
}

}  // namespace strut::align::detail
