// SPDX-License-Identifier: MIT
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include <strut/core/version.h>

namespace strut {
namespace {

TEST(Version, IsMajorMinorPatch) {
  EXPECT_TRUE(std::regex_match(version(), std::regex(R"(\d+\.\d+\.\d+)"))) << version();
}

}  // namespace
}  // namespace strut
