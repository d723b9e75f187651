// SPDX-License-Identifier: MIT
// Tells whether a file is still the one that was read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/core.h>

namespace strut::cli {

/// FNV-1a, 64 bits, in hexadecimal: no protection against forgery.
inline std::string fingerprint(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

}  // namespace strut::cli
