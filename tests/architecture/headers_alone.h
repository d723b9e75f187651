// SPDX-License-Identifier: MIT
// Every public header is compiled as the first line of a translation unit of its own (header_alone.cpp.in), which
// counts itself here, so that a test can tell that none was left out.
#pragma once

#include <set>
#include <string>

namespace strut::test {

/// The headers whose translation units are part of this program.
std::set<std::string>& headers_alone();

/// Adds one; gives true.
bool count_header_alone(const char* header);

}  // namespace strut::test
