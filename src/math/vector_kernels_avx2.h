// SPDX-License-Identifier: MIT
// The kernels compiled for AVX2 with fused multiply-add; there is none where the compiler aims at another processor.
#pragma once

#include "math/vector_kernels.h"

namespace strut::math {

/// Null where they were not compiled.
template <typename T>
const VectorKernels<T>* avx2_kernels() noexcept;

}  // namespace strut::math
