// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"
#include "align/warp_oracle.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kRounding = 1e-9;  // E is a sum of some thousand squares

/// Equation 1, written out.
double objective_of(const FrameMatrix& u, const FrameMatrix& y, const IterativeMotionWarpingResult& result,
                    const IterativeMotionWarpingOptions& options) {
  const Eigen::VectorXd weights = options.weights.size() == 0 ? Eigen::VectorXd::Ones(u.cols()) : options.weights;
  double e = test::cost_of(result.space_warp.apply(u), y, result.time_warp, weights);
  for (Eigen::Index d = 0; d < u.cols(); ++d) {
    for (Eigen::Index t = 1; t < u.rows(); ++t) {
      e += weights[d] * options.space.scale_smoothness *
           std::pow(result.space_warp.scale(t, d) - result.space_warp.scale(t - 1, d), 2);
      e += weights[d] * options.space.offset_smoothness *
           std::pow(result.space_warp.offset(t, d) - result.space_warp.offset(t - 1, d), 2);
    }
  }
  return e;
}

RC_GTEST_PROP(IterativeMotionWarping, NeverRaisesItsObjective, ()) {
  IterativeMotionWarpingOptions options;
  options.slope_limit = *rc::gen::element(1.1, 1.25, 2.0, 2.5, 4.0);
  options.resolution = *rc::gen::element(0, 0, 7, 12);
  options.ends = *rc::gen::element(Ends::kFixed, Ends::kOpenBegin, Ends::kOpenEnd, Ends::kOpen);
  options.exact_steps = *rc::gen::element(std::int64_t{1}, std::int64_t{1} << 28);
  options.band_radius = *rc::gen::inRange(1, 10);
  options.tolerance = 0.0;
  options.max_rounds = 30;
  options.space = {std::pow(10.0, *rc::gen::inRange(-3, 5)), std::pow(10.0, *rc::gen::inRange(-3, 5))};
  const auto seed = *rc::gen::inRange(0U, 100000U);
  if (*rc::gen::inRange(0, 2) == 1) options.weights = test::noise(1, 3, seed).row(0).cwiseAbs();
  const int m = *rc::gen::inRange(2, 100), n = options.ends == Ends::kFixed ? m : 2 * m;
  const FrameMatrix input = test::noise(m, 3, seed), output = test::noise(n, 3, seed + 1);
  const auto result = iterative_motion_warping(input, output, options);
  RC_ASSERT(!result.objective.empty());
  RC_ASSERT(result.is_determined);
  for (std::size_t k = 1; k < result.objective.size(); ++k) RC_ASSERT(result.objective[k] < result.objective[k - 1]);
  const double e = objective_of(input, output, result, options);
  RC_ASSERT(std::abs(result.objective.back() - e) <= kRounding * (1.0 + e));
  const Correspondence& found = result.correspondence;
  RC_ASSERT(std::abs(found.output_end() + found.output_rest - n) < kRounding);
  RC_ASSERT(found.differential_warp.maxCoeff() <= options.slope_limit + kRounding);
  RC_ASSERT(found.differential_warp.minCoeff() >= 1.0 / options.slope_limit - kRounding);
}

RC_GTEST_PROP(IterativeMotionWarping, NeverRaisesItsObjectiveWhateverTheLengths, ()) {
  const int m = *rc::gen::inRange(1, 40);
  const int n = *rc::gen::inRange((m + 1) / 2, 2 * m + 1);
  const auto seed = *rc::gen::inRange(0U, 100000U);
  IterativeMotionWarpingOptions options;
  options.tolerance = 0.0;
  const auto result = iterative_motion_warping(test::noise(m, 3, seed), test::noise(n, 3, seed + 1), options);
  RC_ASSERT(!result.objective.empty());
  for (std::size_t k = 1; k < result.objective.size(); ++k) RC_ASSERT(result.objective[k] < result.objective[k - 1]);
  RC_ASSERT(std::abs(result.correspondence.differential_warp.sum() - n) < kRounding);
}

TEST(IterativeMotionWarping, BeginsWithTheTimeWarpStage) {
  const FrameMatrix input = test::smooth_curves(60, 4, 1), output = test::smooth_curves(75, 4, 2);
  IterativeMotionWarpingOptions options;
  options.max_rounds = 1;
  EXPECT_EQ(iterative_motion_warping(input, output, options).time_warp, time_warp(input, output));
}

/// A gait-like cycle and the same cycle in another style: other pose, other amplitude, other timing. IMW must find the
/// timing where the time warp alone, which sees only poses, cannot.
TEST(IterativeMotionWarping, SeesThroughAChangeOfPoseBetterThanTheTimeWarpAlone) {
  constexpr int kFrames = 120;
  const auto set_pose = [](FrameMatrix& signal, int t, double phase, double size, double offset) {
    signal(t, 0) = size * std::sin(phase) + offset;
    signal(t, 1) = size * std::cos(2.0 * phase) - offset;
  };
  const auto output_phase = [](double j) { return 0.157 * j + 0.5 * std::sin(0.105 * j); };
  const auto input_phase = [](double t) { return 0.157 * t; };
  FrameMatrix input(kFrames, 2), output(kFrames, 2);
  for (int t = 0; t < kFrames; ++t) {
    set_pose(input, t, input_phase(t), 1.0, 0.0);
    set_pose(output, t, output_phase(t), 0.4, 0.9);
  }
  const auto error = [&](const Correspondence& correspondence) {
    const Eigen::VectorXd time = correspondence.output_time();
    double sum = 0.0;
    for (int t = 0; t < kFrames; ++t) sum += std::abs(output_phase(time[t]) - input_phase(t)) / 0.157;
    return sum / kFrames;
  };
  const double found = error(iterative_motion_warping(input, output).correspondence);
  const double time_alone = error(time_warp(input, output).correspondence());
  EXPECT_LT(found, 1.5);  // frames: the spatial warp takes some of the timing on itself
  EXPECT_GT(time_alone, 2.0 * found);
}

TEST(IterativeMotionWarping, OfASignalWithItselfIsTheIdentity) {
  const FrameMatrix signal = test::smooth_curves(90, 5, 8);
  const auto result = iterative_motion_warping(signal, signal);
  EXPECT_EQ(result.time_warp.repetitions, std::vector<int>(90, 2));
  EXPECT_LT(result.objective.back(), kRounding);
}

/// A short stretch in another style, of another size and elsewhere, somewhere in a long clip.
TEST(IterativeMotionWarping, FindsAClipOfAnotherStyleInsideALongOne) {
  constexpr int kBegin = 140, kFrames = 120;
  const FrameMatrix output = test::smooth_curves(400, 4, 5);
  const FrameMatrix input = (1.6 * output.middleRows(kBegin, kFrames)).array() + 0.5;
  IterativeMotionWarpingOptions options;
  options.ends = Ends::kOpen;
  options.slope_limit = 1.5;
  options.max_rounds = 50;
  const auto result = iterative_motion_warping(input, output, options);
  EXPECT_NEAR(result.correspondence.output_begin, kBegin, 5.0);
  EXPECT_NEAR(result.correspondence.output_end(), kBegin + kFrames, 5.0);
}

TEST(IterativeMotionWarping, OfASignalThatStandsStillIsEvenAndSaysSo) {
  const FrameMatrix still = FrameMatrix::Constant(40, 2, 1.5), moving = test::smooth_curves(60, 2, 1);
  const auto of_both = iterative_motion_warping(still, -2.0 * still);
  EXPECT_EQ(of_both.time_warp.repetitions, std::vector<int>(40, 2));
  EXPECT_FALSE(of_both.is_determined);
  const auto of_input = iterative_motion_warping(still, moving);
  EXPECT_EQ(of_input.time_warp.repetitions, std::vector<int>(40, 3));
  EXPECT_FALSE(of_input.is_determined);
  const auto of_output = iterative_motion_warping(moving, FrameMatrix::Constant(60, 2, 0.1));
  EXPECT_EQ(of_output.time_warp.repetitions, std::vector<int>(60, 2));
  EXPECT_FALSE(of_output.is_determined);
  EXPECT_EQ(of_output.objective.size(), 1);
  EXPECT_TRUE(iterative_motion_warping(moving, 2.0 * moving).is_determined);
}

TEST(IterativeMotionWarping, StandsStillWhereWhatMovesWeighsNothing) {
  FrameMatrix input = test::smooth_curves(50, 2, 1);
  input.col(0).setConstant(3.0);
  IterativeMotionWarpingOptions options;
  options.weights = Eigen::Vector2d(1.0, 0.0);
  EXPECT_FALSE(iterative_motion_warping(input, test::smooth_curves(50, 2, 2), options).is_determined);
}

TEST(IterativeMotionWarping, LeavesWhatIsZeroThroughoutAsItIs) {
  const FrameMatrix input = test::smooth_curves(60, 2, 1), output = test::smooth_curves(70, 2, 2);
  FrameMatrix wide_input = FrameMatrix::Zero(60, 5), wide_output = FrameMatrix::Zero(70, 5);
  wide_input.col(1) = input.col(0), wide_input.col(4) = input.col(1);
  wide_output.col(1) = output.col(0), wide_output.col(4) = output.col(1);
  IterativeMotionWarpingOptions options;
  options.weights = Eigen::Vector2d(1.0, 3.0);
  const auto narrow = iterative_motion_warping(input, output, options);
  options.weights.resize(5);
  options.weights << 7.0, 1.0, 0.0, 5.0, 3.0;
  const auto wide = iterative_motion_warping(wide_input, wide_output, options);
  EXPECT_EQ(wide.time_warp, narrow.time_warp);
  EXPECT_EQ(wide.objective, narrow.objective);
  EXPECT_EQ(wide.space_warp.scale.col(4), narrow.space_warp.scale.col(1));
  EXPECT_EQ(wide.space_warp.offset.col(1), narrow.space_warp.offset.col(0));
  EXPECT_EQ(wide.space_warp.scale.col(2), Eigen::VectorXd::Ones(60));
  EXPECT_EQ(wide.space_warp.offset.col(0), Eigen::VectorXd::Zero(60));
}

TEST(IterativeMotionWarping, OfOneFrameIsDefined) {
  const FrameMatrix one = FrameMatrix::Constant(1, 2, 1.5);
  const auto result = iterative_motion_warping(one, 2.0 * one);
  EXPECT_EQ(result.time_warp.repetitions, std::vector<int>{2});
  EXPECT_EQ(result.correspondence.output_time()[0], 0.0);
  EXPECT_FALSE(result.is_determined);
}

TEST(IterativeMotionWarping, CoarseToFineComesAsFarAsTheExactSearch) {
  const FrameMatrix input = test::smooth_curves(500, 5, 1), output = test::smooth_curves(560, 5, 1).array() * 0.7 + 0.2;
  IterativeMotionWarpingOptions options;
  const auto exact = iterative_motion_warping(input, output, options);
  options.exact_steps = 12000;
  options.band_radius = 25;
  const auto found = iterative_motion_warping(input, output, options);
  EXPECT_TRUE(exact.time_warp.is_exact);
  EXPECT_FALSE(found.time_warp.is_exact);
  EXPECT_NEAR(found.objective.back(), exact.objective.back(), 1e-6 * exact.objective.back());
}

TEST(IterativeMotionWarping, RefusesBadOptionsAndSignals) {
  const FrameMatrix signal = test::noise(10, 2, 1);
  IterativeMotionWarpingOptions options;
  options.max_rounds = 0;
  EXPECT_THROW(iterative_motion_warping(signal, signal, options), InvalidArgument);
  options = {};
  options.tolerance = -1.0;
  EXPECT_THROW(iterative_motion_warping(signal, signal, options), InvalidArgument);
  FrameMatrix bad = signal;
  bad(0, 0) = std::numeric_limits<double>::infinity();
  options = {};
  options.weights = Eigen::VectorXd::Zero(2);
  EXPECT_THROW(iterative_motion_warping(signal, signal, options), InvalidArgument);
  options = {};
  options.space.scale_smoothness = -1.0;
  EXPECT_THROW(iterative_motion_warping(signal, signal, options), InvalidArgument);
  EXPECT_THROW(iterative_motion_warping(signal, bad), InvalidArgument);
  EXPECT_THROW(iterative_motion_warping(signal, test::noise(21, 2, 1)), InvalidArgument);
}

}  // namespace
}  // namespace strut::align
