// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/residuals.h>

namespace strut::sysid {
namespace {

TEST(ChiSquaredTail, HasTheTablesValues) {
  EXPECT_NEAR(chi_squared_tail(3.841458820694124, 1.0), 0.05, 1e-12);
  EXPECT_NEAR(chi_squared_tail(6.0, 2.0), std::exp(-3.0), 1e-13);  // two degrees: exponential
  EXPECT_NEAR(chi_squared_tail(37.65248413348277, 25.0), 0.05, 1e-12);
  EXPECT_NEAR(chi_squared_tail(0.5, 2.0), std::exp(-0.25), 1e-13);
  EXPECT_EQ(chi_squared_tail(0.0, 3.0), 1.0);
  EXPECT_NEAR(chi_squared_tail(1e4, 3.0), 0.0, 1e-300);
  EXPECT_EQ(chi_squared_tail(5.0, 0.0), 1.0);
}

/// `count` clips of white noise, filtered by e[t] = `memory` e[t-1] + white.
std::vector<FrameMatrix> noise(int count, int frames, int width, double memory, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<FrameMatrix> clips;
  for (int k = 0; k < count; ++k) {
    clips.push_back(test::white_noise(frames, width, random));
    for (int t = 1; t < frames; ++t) clips.back().row(t) += memory * clips.back().row(t - 1);
  }
  return clips;
}

TEST(ResidualTests, PassWhiteNoise) {
  const ResidualTests tests = test_residuals(noise(20, 100, 2, 0.0, 1), noise(20, 100, 3, 0.8, 2));
  EXPECT_EQ(tests.num_lags(), 25);
  EXPECT_GT(tests.whiteness.minCoeff(), 0.01);
  EXPECT_LE(tests.num_beyond(), 3);                                                           // of 50 at 1 in 100
  EXPECT_LT((tests.cross_correlation.cwiseAbs() - 1.5 * tests.cross_bound).maxCoeff(), 0.0);  // the largest of 26 lags
}

TEST(ResidualTests, CatchColouredNoise) {
  const ResidualTests tests = test_residuals(noise(20, 100, 1, 0.5, 1), noise(20, 100, 1, 0.0, 2));
  EXPECT_LT(tests.whiteness[0], 1e-6);
  EXPECT_NEAR(tests.autocorrelation(0, 0), 0.5, 0.07);  // 2000 frames, thrice over
  EXPECT_GE(tests.num_beyond(), 2);
}

TEST(ResidualTests, CatchWhatTheInputsWouldExplain) {
  const auto inputs = noise(20, 100, 2, 0.5, 3);
  auto residuals = noise(20, 100, 1, 0.5, 4);
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    residuals[k].bottomRows(97) -= 0.5 * inputs[k].col(1).topRows(97);
  }
  const ResidualTests tests = test_residuals(residuals, inputs, 10);
  EXPECT_LT(std::abs(tests.cross_correlation(0, 0)), 1.5 * tests.cross_bound(0, 0));
  EXPECT_LT(tests.cross_correlation(0, 1), -2.0 * tests.cross_bound(0, 1));
}

TEST(ResidualTests, DoNotLookAcrossBorders) {
  FrameMatrix up(2, 1), down(2, 1);
  up << 1.0, 1.0;
  down << -1.0, -1.0;
  const ResidualTests tests = test_residuals({up, down}, {up, down}, 5);
  ASSERT_EQ(tests.num_lags(), 1);
  EXPECT_DOUBLE_EQ(tests.autocorrelation(0, 0), 0.5);  // two products of one over four frames
}

TEST(ResidualTests, StandConstantsAndSingleFrames) {
  const FrameMatrix zero = FrameMatrix::Zero(10, 1), one = FrameMatrix::Ones(10, 1);
  const ResidualTests constant = test_residuals({zero}, {one});
  EXPECT_EQ(constant.whiteness[0], 1.0);
  EXPECT_EQ(constant.cross_correlation(0, 0), 0.0);
  const ResidualTests single = test_residuals({one.topRows(1)}, {one.topRows(1)});
  EXPECT_EQ(single.num_lags(), 0);
  EXPECT_EQ(single.whiteness[0], 1.0);
}

TEST(ResidualTests, RefuseWhatCannotBeMeant) {
  const FrameMatrix one = FrameMatrix::Ones(10, 1);
  EXPECT_THROW(test_residuals({}, {}), InvalidArgument);
  EXPECT_THROW(test_residuals({one}, {}), InvalidArgument);
  EXPECT_THROW(test_residuals({one}, {one.topRows(3)}), InvalidArgument);
  EXPECT_THROW(test_residuals({one}, {one}, 0), InvalidArgument);
  EXPECT_THROW(test_residuals({one * std::nan("")}, {one}), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
