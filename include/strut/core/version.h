// SPDX-License-Identifier: MIT
#pragma once

namespace strut {

/// The library's version, "major.minor.patch".
const char* version() noexcept;

}  // namespace strut
