// SPDX-License-Identifier: MIT
// Counts what is allocated, for what promises to allocate nothing. A test program that uses this is linked with
// --wrap (tests/CMakeLists.txt): Eigen allocates with malloc, which only the linker can put something before.
#pragma once

#include <functional>

namespace strut::test {

/// How often `action` calls malloc, calloc, realloc or operator new (aligned or not), in this thread.
int count_allocations(const std::function<void()>& action);

}  // namespace strut::test
