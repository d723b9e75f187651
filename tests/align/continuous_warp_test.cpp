// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/align/continuous_warp.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kRounding = 1e-9;          // sums of some hundred slopes
constexpr double kFractionOfAFrame = 0.05;  // cubic interpolation and a little smoothing are all that is in the way

/// Four curves of a gait-like cycle at phase `phase` [rad].
Eigen::RowVector4d pose(double phase) {
  return {std::sin(phase), std::cos(phase), std::sin(2.0 * phase + 0.5), std::cos(2.0 * phase + 1.0)};
}

/// A cycle of a second and the same with another timing, at `rate` [frames/s]; the truth in output frames.
struct Warped {
  FrameMatrix input, output;
  Eigen::VectorXd truth;

  explicit Warped(double rate) {
    const auto frames = static_cast<Eigen::Index>(2.0 * rate);
    input.resize(frames, 4);
    output.resize(frames, 4);
    truth.resize(frames);
    // Content runs evenly in the output; the middle of input frame t is at output time t + bulge, zero at both ends.
    for (Eigen::Index t = 0; t < frames; ++t) {
      const double seconds = (static_cast<double>(t) + 0.5) / rate;
      const double warped = seconds + 0.08 * std::sin(2.0 * std::numbers::pi * seconds / 2.0);
      truth[t] = warped * rate - 0.5;
      output.row(t) = pose(2.0 * std::numbers::pi * seconds);
      input.row(t) = pose(2.0 * std::numbers::pi * warped);
    }
  }

  [[nodiscard]] double mean_error(const Correspondence& found) const {
    return (found.output_time() - truth).cwiseAbs().mean();
  }
};

TEST(ContinuousWarp, RecoversASmoothWarpToAFractionOfAFrame) {
  const Warped pair(30.0);
  const double found = pair.mean_error(continuous_warp(pair.input, pair.output, 30.0).correspondence);
  EXPECT_LT(found, kFractionOfAFrame);
  EXPECT_LT(found, 0.5 * pair.mean_error(iterative_motion_warping(pair.input, pair.output).correspondence));
}

TEST(ContinuousWarp, SeesThroughAnotherScaleAndOffset) {
  const Warped pair(30.0);
  const FrameMatrix styled = (0.6 * pair.output).rowwise() + Eigen::RowVector4d(0.5, -1.0, 0.2, 0.0);
  EXPECT_LT(pair.mean_error(continuous_warp(pair.input, styled, 30.0).correspondence), kFractionOfAFrame);
}

TEST(ContinuousWarp, FindsTheSameTimesAtAnotherFrameRate) {
  const Warped slow(30.0), fast(120.0);
  const Eigen::VectorXd at_30 = continuous_warp(slow.input, slow.output, 30.0).correspondence.output_time();
  const Eigen::VectorXd at_120 = continuous_warp(fast.input, fast.output, 120.0).correspondence.output_time();
  for (Eigen::Index t = 1; t + 1 < at_30.size(); ++t) {
    // The middle of frame t at 30 frames/s lies between frames 4 t + 1 and 4 t + 2 at 120.
    const double seconds = 0.5 * (at_120[4 * t + 1] + at_120[4 * t + 2] + 1.0) / 120.0;
    EXPECT_NEAR((at_30[t] + 0.5) / 30.0, seconds, kFractionOfAFrame / 30.0) << t;
  }
}

RC_GTEST_PROP(ContinuousWarp, NeverRaisesItsObjectiveAndStaysInsideTheLimit, ()) {
  const double limit = 1.0 + 0.1 * *rc::gen::inRange(1, 30);
  const int m = *rc::gen::inRange(1, 40);
  const int n = *rc::gen::inRange(static_cast<int>(std::ceil(m / limit)), static_cast<int>(m * limit) + 1);
  const auto seed = *rc::gen::inRange(0U, 100000U);
  ContinuousWarpOptions options;
  options.slope_limit = limit;
  options.slope_reach = 0.001 * *rc::gen::inRange(0, 50);
  options.space_reach = 0.1 * *rc::gen::inRange(0, 20);
  if (*rc::gen::inRange(0, 2) == 1) options.weights = test::noise(1, 3, seed).row(0).cwiseAbs();
  const bool is_smooth = *rc::gen::inRange(0, 2) == 1;
  const auto signal = [&](int frames, unsigned of) {
    return is_smooth ? test::smooth_curves(frames, 3, of) : test::noise(frames, 3, of);
  };
  const Correspondence even{Eigen::VectorXd::Constant(m, static_cast<double>(n) / m)};
  const ContinuousWarp found = refine_warp(signal(m, seed), signal(n, seed + 1), even, 30.0, options);
  RC_ASSERT(!found.objective.empty());
  for (std::size_t k = 1; k < found.objective.size(); ++k) RC_ASSERT(found.objective[k] < found.objective[k - 1]);
  const Eigen::VectorXd& w = found.correspondence.differential_warp;
  RC_ASSERT(std::abs(w.sum() - n) < kRounding);
  RC_ASSERT((w.array() >= 1.0 / limit - kRounding).all());
  RC_ASSERT((w.array() <= limit + kRounding).all());
}

TEST(ContinuousWarp, OfConstantSignalsIsEven) {
  const FrameMatrix still = FrameMatrix::Constant(40, 2, 1.5), other = FrameMatrix::Constant(50, 2, -3.0);
  const Eigen::VectorXd w = continuous_warp(still, other, 30.0).correspondence.differential_warp;
  EXPECT_LT((w.array() - 1.25).abs().maxCoeff(), 1e-4);  // stiff, not rigid: the start was a warp of counts
}

TEST(ContinuousWarp, OfASignalWithItselfIsTheIdentity) {
  const FrameMatrix signal = test::smooth_curves(60, 5, 8);
  const Eigen::VectorXd w = continuous_warp(signal, signal, 30.0).correspondence.differential_warp;
  EXPECT_LT((w.array() - 1.0).abs().maxCoeff(), 1e-6);
}

TEST(ContinuousWarp, IsEvenWhereTheLengthsLeaveNoChoice) {
  ContinuousWarpOptions options;
  options.slope_limit = 2.0;
  const auto found = continuous_warp(test::noise(20, 3, 1), test::noise(40, 3, 2), 30.0, options);
  EXPECT_LT((found.correspondence.differential_warp.array() - 2.0).abs().maxCoeff(), kRounding);
}

TEST(ContinuousWarp, AlignsSingleFrames) {
  const FrameMatrix one = test::noise(1, 2, 1), two = test::noise(2, 2, 2);
  EXPECT_EQ(continuous_warp(one, one, 30.0).correspondence.differential_warp.size(), 1);
  EXPECT_NEAR(continuous_warp(two, one, 30.0).correspondence.differential_warp.sum(), 1.0, kRounding);
  EXPECT_NEAR(continuous_warp(one, two, 30.0).correspondence.differential_warp.sum(), 2.0, kRounding);
}

TEST(ContinuousWarp, LooksOnlyAtWhatWeighs) {
  const Warped pair(30.0);
  FrameMatrix input(pair.input.rows(), 6), output(pair.output.rows(), 6);
  input << pair.input, test::noise(60, 2, 1);
  output << pair.output, test::noise(60, 2, 2);
  ContinuousWarpOptions options;
  options.weights = (Eigen::VectorXd(6) << 1, 1, 1, 1, 0, 0).finished();
  EXPECT_LT(pair.mean_error(continuous_warp(input, output, 30.0, options).correspondence), kFractionOfAFrame);
  EXPECT_GT(pair.mean_error(continuous_warp(input, output, 30.0).correspondence), kFractionOfAFrame);
}

void expect_refused(const ContinuousWarpOptions& options, double frame_rate = 30.0) {
  const FrameMatrix signal = test::noise(10, 2, 1);
  EXPECT_THROW(continuous_warp(signal, signal, frame_rate, options), InvalidArgument);
}

TEST(ContinuousWarp, RefusesBadOptions) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  expect_refused({.slope_limit = 1.0});
  expect_refused({.slope_limit = kNaN});
  expect_refused({.slope_reach = -1.0});
  expect_refused({.space_reach = kNaN});
  expect_refused({.max_rounds = 0});
  expect_refused({.tolerance = -1.0});
  expect_refused({}, 0.0);
  expect_refused({.weights = Eigen::VectorXd::Zero(2)});
  expect_refused({.weights = Eigen::Vector2d(1.0, -1.0)});
  expect_refused({.weights = Eigen::VectorXd::Ones(3)});
}

TEST(ContinuousWarp, RefusesBadSignalsAndStarts) {
  const FrameMatrix signal = test::noise(10, 2, 1);
  FrameMatrix bad = signal;
  bad(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(continuous_warp(bad, signal, 30.0), InvalidArgument);
  EXPECT_THROW(continuous_warp(signal, bad, 30.0), InvalidArgument);
  EXPECT_THROW(continuous_warp(signal, test::noise(31, 2, 1), 30.0), InvalidArgument);
  EXPECT_THROW(continuous_warp(signal, test::noise(10, 3, 1), 30.0), InvalidArgument);
  EXPECT_THROW(refine_warp(signal, signal, {Eigen::VectorXd::Ones(9)}, 30.0), InvalidArgument);
  EXPECT_THROW(refine_warp(signal, signal, {-Eigen::VectorXd::Ones(10)}, 30.0), InvalidArgument);
  EXPECT_THROW(refine_warp(signal, signal, {Eigen::VectorXd::Ones(10), 2.0, 0.0}, 30.0), InvalidArgument);
}

}  // namespace
}  // namespace strut::align
