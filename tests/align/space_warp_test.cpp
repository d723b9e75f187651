// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <strut/align/space_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kRidgeEffect = 1e-6;  // the ridge of 1e-8 against smallest eigenvalues of about 1e-2

/// Equation 4 as it is printed, with W, F and G written out.
Eigen::VectorXd dense_solution(const Eigen::VectorXd& u, const Eigen::VectorXd& y, const std::vector<int>& counts,
                               int s, const SpaceWarpOptions& options) {
  const Eigen::Index m = u.size(), slots = y.size() * s;
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(slots, m);
  Eigen::VectorXd lengthened(slots);
  for (Eigen::Index x = 0; x < slots; ++x) lengthened[x] = y[x / s];
  Eigen::Index slot = 0;
  for (Eigen::Index t = 0; t < m; ++t) {
    for (int k = 0; k < counts[static_cast<std::size_t>(t)]; ++k) w(slot++, t) = 1.0;
  }
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(m - 1, m);
  for (Eigen::Index t = 0; t + 1 < m; ++t) d(t, t) = -1.0, d(t, t + 1) = 1.0;
  const Eigen::MatrixXd ww = w.transpose() * w, dd = d.transpose() * d, uu = u.asDiagonal();
  Eigen::MatrixXd normal(2 * m, 2 * m);
  normal << uu * ww * uu + options.scale_smoothness * dd, uu * ww, ww * uu, ww + options.offset_smoothness * dd;
  Eigen::VectorXd right(2 * m);
  right << uu * w.transpose() * lengthened, w.transpose() * lengthened;
  return normal.ldlt().solve(right);
}

TEST(SpaceWarp, SolvesEquationFour) {
  const std::vector<int> counts{1, 3, 4, 2, 1, 2, 3, 4, 2};  // 22 slots: 11 output frames lengthened twice
  const SpaceWarpOptions options{7.0, 30.0};
  const FrameMatrix input = test::noise(9, 3, 1), output = test::noise(11, 3, 2);
  const SpaceWarp warp = space_warp(input, output, {counts, 2}, options);
  for (int d = 0; d < 3; ++d) {
    const Eigen::VectorXd expected = dense_solution(input.col(d), output.col(d), counts, 2, options);
    EXPECT_LT((warp.scale.col(d) - expected.head(9)).norm(), kRidgeEffect * expected.norm());
    EXPECT_LT((warp.offset.col(d) - expected.tail(9)).norm(), kRidgeEffect * expected.norm());
  }
}

/// Where frames count, a frame's slots share the weight of one output frame: solved as least squares over slots.
TEST(SpaceWarp, WeighsEveryFrameAlikeWhereFramesCount) {
  const TimeWarp time_warp{{1, 3, 4, 2, 2}, 2, 3, 5, true};  // 20 slots
  const SpaceWarpOptions options{7.0, 30.0};
  const FrameMatrix input = test::noise(5, 1, 1), output = test::noise(10, 1, 2);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(12 + 8, 10);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(12 + 8);
  int slot = time_warp.begin;
  for (int t = 0; t < 5; ++t) {
    const int count = time_warp.repetitions[static_cast<std::size_t>(t)];
    const double root = std::sqrt(2.0 / count);
    for (int k = 0; k < count; ++k, ++slot) {
      system(slot - 3, t) = root * input(t, 0);
      system(slot - 3, 5 + t) = root;
      right[slot - 3] = root * output(slot / 2, 0);
    }
  }
  for (int t = 0; t < 4; ++t) {
    system(12 + t, t) = -std::sqrt(7.0), system(12 + t, t + 1) = std::sqrt(7.0);
    system(16 + t, 5 + t) = -std::sqrt(30.0), system(16 + t, 6 + t) = std::sqrt(30.0);
  }
  const Eigen::VectorXd expected = system.colPivHouseholderQr().solve(right);
  const SpaceWarp warp = space_warp(input, output, time_warp, options);
  EXPECT_LT((warp.scale.col(0) - expected.head(5)).norm(), kRidgeEffect * expected.norm());
  EXPECT_LT((warp.offset.col(0) - expected.tail(5)).norm(), kRidgeEffect * expected.norm());
}

TEST(SpaceWarp, FindsAScaleAndOffsetThatDoNotChange) {
  const FrameMatrix input = test::smooth_curves(80, 2, 3);
  const FrameMatrix output = (2.5 * input).array() - 0.75;
  const SpaceWarp warp = space_warp(input, output, {std::vector<int>(80, 2), 2});
  EXPECT_LT((warp.scale.array() - 2.5).abs().maxCoeff(), kRidgeEffect);
  EXPECT_LT((warp.offset.array() + 0.75).abs().maxCoeff(), kRidgeEffect);
  EXPECT_LT((warp.apply(input) - output).cwiseAbs().maxCoeff(), kRidgeEffect);
}

TEST(SpaceWarp, OfConstantSignalsIsFiniteAndFits) {
  for (const double value : {0.0, 1e-3, 1.0, 50.0}) {
    const FrameMatrix input = FrameMatrix::Constant(200, 1, value), output = FrameMatrix::Constant(200, 1, -2.0);
    const SpaceWarp warp = space_warp(input, output, {std::vector<int>(200, 2), 2});
    EXPECT_LT((warp.apply(input) - output).cwiseAbs().maxCoeff(), kRidgeEffect) << value;
    EXPECT_LT(warp.scale.maxCoeff() - warp.scale.minCoeff(), kRidgeEffect) << value;
  }
}

TEST(SpaceWarp, OfASingleFrameFits) {
  const FrameMatrix one = FrameMatrix::Constant(1, 1, 3.0);
  EXPECT_NEAR(space_warp(one, 2.0 * one, {{2}, 2}).apply(one)(0, 0), 6.0, kRidgeEffect);
}

TEST(SpaceWarp, RefusesCountsThatDoNotFill) {
  const FrameMatrix signal = FrameMatrix::Zero(3, 1);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2}, 2}), InvalidArgument);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2, 1}, 2}), InvalidArgument);
  EXPECT_THROW(space_warp(signal, signal, {{6, 0, 0}, 2}), InvalidArgument);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2, 3}, 2, -1}), InvalidArgument);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2, 2}, 0}), InvalidArgument);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2, 2}, 2, 1, 0}), InvalidArgument);
}

TEST(SpaceWarp, RefusesNegativeSmoothness) {
  const FrameMatrix signal = FrameMatrix::Zero(3, 1);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2, 2}, 2}, {-1.0, 1.0}), InvalidArgument);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2, 2}, 2}, {1.0, std::nan("")}), InvalidArgument);
  EXPECT_THROW(space_warp(signal, signal, {{2, 2, 2}, 2}, {1e13, 1.0}), InvalidArgument);
}

}  // namespace
}  // namespace strut::align
