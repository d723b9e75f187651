// SPDX-License-Identifier: MIT
// That every public header really was compiled alone. The compiling itself is done by the build of this program.
#include "architecture/headers_alone.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace strut::test {

std::set<std::string>& headers_alone() {
  static std::set<std::string> headers;
  return headers;
}

bool count_header_alone(const char* header) {
  return headers_alone().insert(header).second;
}

namespace {

namespace fs = std::filesystem;

TEST(PublicHeaders, AreEachCompiledAlone) {
  const fs::path root = fs::path(STRUT_TEST_SOURCE_DIR) / "include";
  std::set<std::string> expected;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.is_regular_file()) expected.insert(entry.path().lexically_relative(root).string());
  }
  EXPECT_GT(expected.size(), 30U);
  EXPECT_EQ(headers_alone(), expected);
}

}  // namespace
}  // namespace strut::test
