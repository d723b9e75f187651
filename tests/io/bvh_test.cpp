// SPDX-License-Identifier: MIT
#include "support/data.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/motion/kinematics.h>

namespace strut {
namespace {

// A kept number may differ from its source by this much (degrees or file units).
constexpr double kKeptNumber = 1e-5;

std::vector<double> numbers_of(const std::string& text) {
  return *parse_bvh(text, "again.bvh").layout.source_values;
}

TEST(RealClips, ComeBackNumberForNumberWithTheirHeader) {
  STRUT_REQUIRE_REAL_DATA();
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::real_data() + "/bandai-namco")) {
    if (entry.path().extension() != ".bvh" || count++ % 16 != 0) continue;
    const std::string source = read_file(entry.path());
    const BvhClip clip = parse_bvh(source, entry.path());
    const std::string written = format_bvh(clip.motion, clip.layout);
    const auto end = source.find("0.0333333");
    ASSERT_EQ(written.substr(0, end), source.substr(0, end));
    const std::vector<double> before = *clip.layout.source_values, after = numbers_of(written);
    ASSERT_EQ(before.size(), after.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) worst = std::max(worst, std::abs(before[i] - after[i]));
    EXPECT_LT(worst, kKeptNumber) << entry.path();
  }
  EXPECT_GT(count, 400);
}

}  // namespace
}  // namespace strut
