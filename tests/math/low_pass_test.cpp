// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include <strut/math/low_pass.h>

namespace strut::math {
namespace {

TEST(LowPassGain, LeavesOneEthOfAStepAfterItsTimeConstant) {
  constexpr int kFrames = 12;
  const double gain = low_pass_gain(kFrames);
  double value = 0.0;
  for (int t = 0; t < kFrames; ++t) value += gain * (1.0 - value);
  EXPECT_NEAR(1.0 - value, std::exp(-1.0), 1e-12);
}

TEST(LowPassGain, SmoothsNothingWithoutATimeConstant) {
  EXPECT_EQ(low_pass_gain(0.0), 1.0);
  EXPECT_EQ(low_pass_gain(-1.0), 1.0);
}

}  // namespace
}  // namespace strut::math
