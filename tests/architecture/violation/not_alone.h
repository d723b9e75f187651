// SPDX-License-Identifier: MIT
// A header that forgets an include it needs, for the test that compiles headers alone.
#pragma once

inline std::string forgetful() {
  return {};
}
