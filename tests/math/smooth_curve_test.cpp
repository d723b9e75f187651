// SPDX-License-Identifier: MIT
#include <algorithm>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/math/smooth_curve.h>

namespace strut::math {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kDifference = 1e-6;  // step of a central difference; its own error is its square

TEST(SmoothCurve, PassesThroughItsKnotsAndReproducesLines) {
  const SmoothCurve curve({0.0, 1.0, 3.0, 4.0}, {1.0, 5.0, 5.0, -2.0});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(curve.at(curve.x()[i]), curve.y()[i], kRounding);
  const SmoothCurve line({0.0, 1.0, 3.0}, {1.0, 3.0, 7.0});
  for (double x = -1.0; x < 4.0; x += 0.1) EXPECT_NEAR(line.at(x), 1.0 + 2.0 * x, kRounding);
}

TEST(SmoothCurve, StaysBetweenNeighbouringKnotsAndIsConstantBetweenEqualOnes) {
  const SmoothCurve curve({0.0, 1.0, 3.0, 4.0, 4.1}, {1.0, 5.0, 5.0, -2.0, 90.0});
  for (std::size_t i = 0; i + 1 < curve.x().size(); ++i) {
    const auto [low, high] = std::minmax(curve.y()[i], curve.y()[i + 1]);
    for (double u = 0.0; u <= 1.0; u += 0.01) {
      const double y = curve.at(curve.x()[i] + u * (curve.x()[i + 1] - curve.x()[i]));
      EXPECT_GE(y, low - kRounding);
      EXPECT_LE(y, high + kRounding);
    }
  }
  EXPECT_EQ(curve.at(1.7), 5.0);
}

TEST(SmoothCurve, SlopeIsTheDerivative) {
  const SmoothCurve curve({0.0, 1.0, 3.0, 4.0}, {0.0, 1.0, 2.0, 7.0});
  for (double x = 0.05; x < 4.0; x += 0.1) {
    EXPECT_NEAR(curve.slope(x), (curve.at(x + kDifference) - curve.at(x - kDifference)) / (2.0 * kDifference), 1e-6);
  }
}

TEST(SmoothCurve, InverseFindsTheArgumentBack) {
  const SmoothCurve curve({0.0, 1.0, 3.0, 4.0}, {0.0, 1.0, 2.0, 7.0});
  for (double x = -1.0; x < 5.0; x += 0.13) EXPECT_NEAR(curve.inverse(curve.at(x)), x, 1e-9);
}

TEST(SmoothCurve, RefusesKnotsThatDoNotAscend) {
  EXPECT_THROW(SmoothCurve({0.0}, {0.0}), InvalidArgument);
  EXPECT_THROW(SmoothCurve({0.0, 0.0}, {0.0, 1.0}), InvalidArgument);
  EXPECT_THROW(SmoothCurve({0.0, 1.0}, {0.0}), InvalidArgument);
}

}  // namespace
}  // namespace strut::math
