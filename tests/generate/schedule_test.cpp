// SPDX-License-Identifier: MIT
#include <limits>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/schedule.h>

namespace strut::generate {
namespace {

TEST(Schedule, IsLinearBetweenKeysAndConstantOutside) {
  const Schedule ramp({{1.0, 2.0}, {3.0, 6.0}});
  EXPECT_DOUBLE_EQ(ramp.at(0.0), 2.0);
  EXPECT_DOUBLE_EQ(ramp.at(1.5), 3.0);
  EXPECT_DOUBLE_EQ(ramp.at(9.0), 6.0);
}

TEST(Schedule, MeanIsTheExactIntegral) {
  const Schedule ramp({{1.0, 2.0}, {3.0, 6.0}});
  EXPECT_DOUBLE_EQ(ramp.mean(0.0, 4.0), (2.0 + 8.0 + 6.0) / 4.0);
  EXPECT_DOUBLE_EQ(ramp.mean(1.5, 2.5), 4.0);
  EXPECT_DOUBLE_EQ(ramp.mean(2.0, 2.0), 4.0);
  EXPECT_DOUBLE_EQ(Schedule(1.3).mean(-5.0, 70.0), 1.3);
}

TEST(Schedule, RefusesKeysThatDoNotAscendOrAreNotFinite) {
  using Keys = std::vector<ScheduleKey>;
  EXPECT_THROW(Schedule(Keys{}), InvalidArgument);
  EXPECT_THROW(Schedule(Keys{{1.0, 0.0}, {1.0, 1.0}}), InvalidArgument);
  EXPECT_THROW(Schedule(Keys{{1.0, std::numeric_limits<double>::quiet_NaN()}}), InvalidArgument);
}

}  // namespace
}  // namespace strut::generate
