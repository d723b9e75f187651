// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/effort_curve.h>

namespace strut::effort {
namespace {

constexpr double kRounding = 1e-12;  // of a cubic through its own knots

TEST(EffortCurve, StaysWhereItWasPut) {
  const EffortCurve curve(EffortVector(0.5, kNotRated, -1.0));
  EXPECT_TRUE(curve.asks_for(kFlow));
  EXPECT_FALSE(curve.asks_for(kWeight));
  for (const double time : {-1.0, 0.0, 100.0}) {
    EXPECT_EQ(curve.at(time)[kFlow], 0.5);
    EXPECT_FALSE(is_rated(curve.at(time)[kWeight]));
    EXPECT_EQ(curve.at(time)[kTime], -1.0);
  }
}

TEST(EffortCurve, GoesThroughItsKeysWithoutLeavingTheirRange) {
  const EffortCurve curve(std::vector<EffortKey>{
      {1.0, {kNotRated, kNotRated, -1.0}}, {2.0, {kNotRated, kNotRated, 1.0}}, {4.0, {kNotRated, kNotRated, 1.0}}});
  EXPECT_EQ(curve.at(0.0)[kTime], -1.0);
  EXPECT_NEAR(curve.at(2.0)[kTime], 1.0, kRounding);
  EXPECT_NEAR(curve.at(3.0)[kTime], 1.0, kRounding);
  EXPECT_GT(curve.at(1.6)[kTime], curve.at(1.4)[kTime]);
  for (double time = 0.0; time < 5.0; time += 0.05) EXPECT_LE(curve.at(time)[kTime], 1.0 + kRounding);
}

TEST(EffortCurve, RefusesWhatMakesNoSense) {
  const auto keys = [](double time, double first, double second) {
    return std::vector<EffortKey>{{0.0, {first, kNotRated, kNotRated}}, {time, {second, kNotRated, kNotRated}}};
  };
  EXPECT_NO_THROW(EffortCurve(keys(1.0, 1.0, -1.0)));
  EXPECT_THROW(EffortCurve(keys(0.0, 0.1, 0.2)), InvalidArgument);
  EXPECT_THROW(EffortCurve(keys(1.0, 0.1, 1.01)), InvalidArgument);
  EXPECT_THROW(EffortCurve(keys(1.0, 0.1, kNotRated)), InvalidArgument);
  EXPECT_THROW(EffortCurve(keys(1.0, kNotRated, kNotRated)), InvalidArgument);
  EXPECT_THROW(EffortCurve(std::vector<EffortKey>{}), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
