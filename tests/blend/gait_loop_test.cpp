// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <strut/blend/gait_loop.h>
#include <strut/core/error.h>

namespace strut::blend {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kClosed = 1e-3;  // what is promised of a cycle's ends [rad, m, per second]

constexpr int kSignals = 9, kHarmonics = 12;

/// A cycle that does not close: harmonics up to the third and a drift.
FrameMatrix open_cycle(int samples, double drift) {
  FrameMatrix rows(samples, kSignals);
  for (int k = 0; k < samples; ++k) {
    const double phase = (k + 0.5) / samples;
    for (int d = 0; d < kSignals; ++d) {
      rows(k, d) = 0.2 * d + std::sin(2.0 * std::numbers::pi * (1 + d % 3) * phase) + drift * phase;
    }
  }
  rows.rightCols<1>().setConstant(std::log(1.1));
  return rows;
}

GaitLoop loop_of(double drift) {
  Eigen::VectorXd gap = Eigen::VectorXd::Constant(kSignals, drift);
  gap[kSignals - 1] = 0.0;
  return {fit_series(open_cycle(64, drift), gap, kHarmonics), {PlantPhase{0.0, 0.6}, PlantPhase{0.5, 1.1}}};
}

TEST(GaitLoop, ClosesInPoseAndVelocity) {
  const GaitLoop loop = loop_of(0.1);
  EXPECT_LT((loop.at(1.0) - loop.at(0.0)).cwiseAbs().maxCoeff(), kClosed);
  EXPECT_LT((loop.rate_at(1.0) - loop.rate_at(0.0)).cwiseAbs().maxCoeff() / loop.duration(), kClosed);
}

TEST(GaitLoop, KeepsWhatClosesAlready) {
  const GaitLoop loop = loop_of(0.0);
  const FrameMatrix rows = open_cycle(64, 0.0);
  for (int k = 0; k < 64; ++k) {
    EXPECT_LT((loop.at((k + 0.5) / 64).transpose() - rows.row(k)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(GaitLoop, RateIsTheDerivative) {
  const GaitLoop loop = loop_of(0.1);
  const Eigen::VectorXd difference = (loop.at(0.3 + 1e-5) - loop.at(0.3 - 1e-5)) / 2e-5;
  EXPECT_LT((loop.rate_at(0.3) - difference).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(GaitLoop, TakesAsLongAsItsPaceSays) {
  EXPECT_NEAR(loop_of(0.0).duration(), 1.1, 1e-9);
  EXPECT_NEAR(loop_of(0.0).pace(0.2), 1.0 / 1.1, 1e-9);
}

TEST(GaitLoop, PacksAndUnpacks) {
  const GaitLoop loop = loop_of(0.1);
  const GaitLoop again = GaitLoop::unpacked(loop.packed(), kSignals);
  EXPECT_LT((again.series() - loop.series()).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_EQ(again.plants()[1].end, loop.plants()[1].end);
  EXPECT_THROW(GaitLoop::unpacked(loop.packed().head(20), kSignals), InvalidArgument);
}

TEST(GaitLoop, FourierBasisIsOrthonormalOverACycle) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(7, 7);
  for (int k = 0; k < 32; ++k) gram += fourier_basis(k / 32.0, 3) * fourier_basis(k / 32.0, 3).transpose() / 32.0;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), kRounding);
}

TEST(PlantPhase, HoldsAcrossTheCyclesEnd) {
  const PlantPhase plant{0.5, 1.1};
  EXPECT_TRUE(plant.holds(0.6));
  EXPECT_TRUE(plant.holds(1.05));
  EXPECT_TRUE(plant.holds(7.05));
  EXPECT_FALSE(plant.holds(0.3));
}

TEST(GaitLoop, RefusesWhatIsNoSeries) {
  EXPECT_THROW(GaitLoop(FrameMatrix::Zero(9, 4), {}), InvalidArgument);
  EXPECT_THROW(GaitLoop(FrameMatrix::Zero(3, 5), {}), InvalidArgument);
  EXPECT_THROW(GaitLoop(FrameMatrix::Constant(9, 5, std::nan("")), {}), InvalidArgument);
  EXPECT_THROW(fit_series(open_cycle(20, 0.0), Eigen::VectorXd::Zero(kSignals), kHarmonics), InvalidArgument);
}

}  // namespace
}  // namespace strut::blend
