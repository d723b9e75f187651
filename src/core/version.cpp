// SPDX-License-Identifier: MIT
#include <strut_version.h>

#include <strut/core/version.h>

namespace strut {

const char* version() noexcept {
  return STRUT_VERSION_STRING;
}

}  // namespace strut
