// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

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
  const FrameMatrix warped = test::repeated(result.space_warp.apply(u), result.time_warp.repetitions);
  const FrameMatrix lengthened =
      test::repeated(y, std::vector<int>(static_cast<std::size_t>(y.rows()), result.time_warp.resolution));
  double e = 0.0;
  for (Eigen::Index d = 0; d < u.cols(); ++d) {
    double of_this = (warped.col(d) - lengthened.col(d)).squaredNorm();
    for (Eigen::Index t = 1; t < u.rows(); ++t) {
      of_this += options.space.scale_smoothness *
                 std::pow(result.space_warp.scale(t, d) - result.space_warp.scale(t - 1, d), 2);
      of_this += options.space.offset_smoothness *
                 std::pow(result.space_warp.offset(t, d) - result.space_warp.offset(t - 1, d), 2);
    }
    e += (options.weights.size() == 0 ? 1.0 : options.weights[d]) * of_this;
  }
  return e;
}

RC_GTEST_PROP(IterativeMotionWarping, NeverRaisesItsObjective, ()) {
  const int m = *rc::gen::inRange(1, 40);
  const int n = *rc::gen::inRange((m + 1) / 2, 2 * m + 1);
  const auto seed = *rc::gen::inRange(0U, 100000U);
  IterativeMotionWarpingOptions options;
  options.tolerance = 0.0;
  options.max_rounds = 30;
  options.space = {std::pow(10.0, *rc::gen::inRange(-3, 5)), std::pow(10.0, *rc::gen::inRange(-3, 5))};
  if (*rc::gen::inRange(0, 2) == 1) options.weights = test::noise(1, 3, seed).row(0).cwiseAbs();
  const FrameMatrix input = test::noise(m, 3, seed), output = test::noise(n, 3, seed + 1);
  const auto result = iterative_motion_warping(input, output, options);
  RC_ASSERT(!result.objective.empty());
  for (std::size_t k = 1; k < result.objective.size(); ++k) RC_ASSERT(result.objective[k] < result.objective[k - 1]);
  const double e = objective_of(input, output, result, options);
  RC_ASSERT(std::abs(result.objective.back() - e) <= kRounding * (1.0 + e));
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

TEST(IterativeMotionWarping, OfConstantSignalsIsEven) {
  const FrameMatrix still = FrameMatrix::Constant(40, 2, 1.5);
  const auto result = iterative_motion_warping(still, -2.0 * still);
  EXPECT_EQ(result.time_warp.repetitions, std::vector<int>(40, 2));
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
  EXPECT_THROW(iterative_motion_warping(signal, bad), InvalidArgument);
  EXPECT_THROW(iterative_motion_warping(signal, test::noise(21, 2, 1)), InvalidArgument);
}

}  // namespace
}  // namespace strut::align
