// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/align/correspondence.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kRounding = 1e-12;  // sums of some hundred numbers of size one

Eigen::VectorXd random_warp() {
  const auto steps = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 5)));
  return from_repetitions(steps, 2).differential_warp;
}

TEST(Correspondence, OfEqualLengthsAndEvenStepsIsTheFrameItself) {
  const Correspondence even{Eigen::VectorXd::Ones(5)};
  EXPECT_TRUE(even.output_time().isApprox(Eigen::VectorXd::LinSpaced(5, 0, 4), kRounding));
}

TEST(Correspondence, PointsAtTheMiddleOfTheStretchCovered) {
  const Correspondence halves = from_repetitions({1, 1, 4, 2}, 2);  // 0.5 0.5 2 1
  Eigen::VectorXd expected(4);
  expected << 0.0, 0.25, 1.5, 3.0;  // the first would be -0.25: clamped to the first output frame
  EXPECT_TRUE(halves.output_time().isApprox(expected, kRounding)) << halves.output_time().transpose();
}

TEST(Correspondence, BeginsAndEndsInsideTheOutputWhereItsEndsAreOpen) {
  const Correspondence inside{Eigen::Vector3d(1.0, 2.0, 1.0), 4.0, 2.5};
  EXPECT_TRUE(inside.output_time().isApprox(Eigen::Vector3d(4.0, 5.5, 7.0), kRounding));
  EXPECT_DOUBLE_EQ(inside.output_end(), 8.0);
  const Correspondence at_ends{Eigen::Vector2d(0.5, 0.5), 0.0, 0.25};  // 1.25 frames: clamped to 0 and 0.25
  EXPECT_TRUE(at_ends.output_time().isApprox(Eigen::Vector2d(0.0, 0.25), kRounding));
}

TEST(Correspondence, OfRepetitionsRefusesNoResolution) {
  EXPECT_THROW(from_repetitions({1, 2}, 0), InvalidArgument);
}

RC_GTEST_PROP(Correspondence, RisesAndStaysInsideTheOutput, ()) {
  const Correspondence correspondence{random_warp()};
  const Eigen::VectorXd time = correspondence.output_time();
  RC_ASSERT(time.minCoeff() >= 0.0);
  RC_ASSERT(time.maxCoeff() <= std::max(0.0, correspondence.differential_warp.sum() - 1.0));
  for (Eigen::Index i = 1; i < time.size(); ++i) RC_ASSERT(time[i] >= time[i - 1]);
}

RC_GTEST_PROP(SmoothedWarp, KeepsItsSumAndItsBounds, ()) {
  const Eigen::VectorXd w = random_warp();
  const Eigen::VectorXd v = smooth_differential_warp(w, *rc::gen::inRange(0, 1000));
  RC_ASSERT(std::abs(v.sum() - w.sum()) < kRounding * (1.0 + w.sum()));
  RC_ASSERT(v.minCoeff() >= w.minCoeff() - kRounding);
  RC_ASSERT(v.maxCoeff() <= w.maxCoeff() + kRounding);
}

TEST(SmoothedWarp, SolvesItsLeastSquaresProblem) {
  const Eigen::VectorXd w = test::noise(7, 1, 1).col(0);
  Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(6, 7);
  for (int i = 0; i < 6; ++i) difference(i, i) = -1.0, difference(i, i + 1) = 1.0;
  const Eigen::VectorXd v = smooth_differential_warp(w, 3.0);
  const Eigen::VectorXd gradient = (v - w) + 3.0 * difference.transpose() * difference * v;
  EXPECT_LT(gradient.norm(), kRounding);
}

TEST(SmoothedWarp, WithoutSmoothnessIsTheWarp) {
  const Eigen::VectorXd w = test::noise(7, 1, 1).col(0);
  EXPECT_EQ(smooth_differential_warp(w, 0.0), w);
  EXPECT_EQ(smooth_differential_warp(w.head(1), 100.0)[0], w[0]);
}

TEST(SmoothedWarp, RefusesWhatIsNotANumber) {
  Eigen::VectorXd w = Eigen::VectorXd::Ones(3);
  EXPECT_THROW(smooth_differential_warp(w, -1.0), InvalidArgument);
  w[1] = std::nan("");
  EXPECT_THROW(smooth_differential_warp(w, 1.0), InvalidArgument);
}

TEST(ShareAtSlopeLimit, CountsBothDirections) {
  EXPECT_DOUBLE_EQ(share_at_slope_limit(from_repetitions({1, 2, 3, 4}, 2).differential_warp, 2), 0.5);
  EXPECT_DOUBLE_EQ(share_at_slope_limit(from_repetitions({2, 3, 4, 8}, 3).differential_warp, 3), 0.0);
  EXPECT_DOUBLE_EQ(share_at_slope_limit(from_repetitions({1, 9}, 3).differential_warp, 3), 1.0);
}

TEST(ShareAtSlopeLimit, SeesASmoothedWarpRunAlongIt) {
  std::vector<int> counts(40, 2);
  std::fill(counts.begin(), counts.begin() + 20, 4);
  const Eigen::VectorXd w = smooth_differential_warp(from_repetitions(counts, 2).differential_warp, 10.0);
  EXPECT_NEAR(share_at_slope_limit(w, 2), 0.4, 0.1);  // half of it, less the edge that smoothing takes off
}

TEST(WarpToInput, UndoesAKnownRepetition) {
  const FrameMatrix input = test::smooth_curves(20, 3, 5);
  const std::vector<int> counts(20, 2);
  const FrameMatrix output = test::repeated(input, counts);
  const FrameMatrix warped = warp_to_input(output, from_repetitions(counts, 1));
  EXPECT_TRUE(warped.isApprox(input, kRounding));
}

TEST(WarpToInput, RefusesAnotherLength) {
  EXPECT_THROW(warp_to_input(FrameMatrix::Zero(5, 1), {Eigen::VectorXd::Ones(4)}), InvalidArgument);
  EXPECT_THROW(warp_to_input(FrameMatrix::Zero(5, 1), {Eigen::VectorXd::Ones(4), 0.5}), InvalidArgument);
  EXPECT_NO_THROW(warp_to_input(FrameMatrix::Zero(5, 1), {Eigen::VectorXd::Ones(4), 0.5, 0.5}));
  EXPECT_THROW(warp_to_input(FrameMatrix::Zero(5, 1), {Eigen::VectorXd::Ones(4), -0.5, 1.5}), InvalidArgument);
  EXPECT_THROW(warp_to_input(FrameMatrix::Zero(5, 1), {Eigen::VectorXd::Constant(5, std::nan(""))}), InvalidArgument);
}

}  // namespace
}  // namespace strut::align
