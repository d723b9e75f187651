// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <strut/align/warp_curve.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kRounding = 1e-9;       // of sums over some hundred frames
constexpr double kDifference = 1e-5;     // step of a central difference; a cubic's own error is its square
constexpr double kSlopeError = 1e-6;     // of that difference
constexpr double kInterpolation = 0.01;  // a cubic between frames of a smooth warp [frames]

/// A smooth warp of `frames` frames that covers `output` frames.
Correspondence wavy(int frames, double output, double depth = 0.4) {
  Correspondence found{Eigen::VectorXd(frames)};
  for (int t = 0; t < frames; ++t) found.differential_warp[t] = 1.0 + depth * std::sin(0.11 * t + 0.5);
  found.differential_warp *= output / found.differential_warp.sum();
  return found;
}

TEST(WarpCurve, AgreesWithTheCorrespondenceOverWholeFrames) {
  const Correspondence found = wavy(90, 120.0);
  const WarpCurve curve(found);
  for (int t = 0; t < 90; ++t) {
    EXPECT_NEAR(curve.output_frame(t + 0.5) - curve.output_frame(t - 0.5), found.differential_warp[t], kRounding);
    EXPECT_NEAR(curve.output_frame(t), found.output_time()[t], t == 0 || t == 89 ? 1.0 : kInterpolation);
  }
}

TEST(WarpCurve, RisesStrictlyAndItsInverseUndoesIt) {
  Correspondence stairs{Eigen::VectorXd(40)};  // the repetitions of a time warp, unsmoothed
  for (int t = 0; t < 40; ++t) stairs.differential_warp[t] = t % 3 == 0 ? 2.0 : 0.5;
  const WarpCurve curve(stairs);
  double before = curve.output_frame(-2.0);
  for (double t = -1.95; t < 42.0; t += 0.05) {
    const double here = curve.output_frame(t);
    EXPECT_GT(here, before);
    EXPECT_NEAR(curve.input_frame(here), t, kRounding);
    before = here;
  }
}

TEST(WarpCurve, HasTheSlopeOfItsValues) {
  const WarpCurve curve(wavy(60, 50.0));
  for (double t = 0.0; t < 59.0; t += 0.37) {
    const double chord =
        (curve.output_frame(t + kDifference) - curve.output_frame(t - kDifference)) / (2 * kDifference);
    EXPECT_NEAR(curve.slope(t), chord, kSlopeError);
    EXPECT_GT(curve.slope(t), 0.0);
  }
}

TEST(WarpCurve, BeginsWhereTheCorrespondenceDoes) {
  Correspondence inside = wavy(60, 50.0);
  const WarpCurve from_zero(inside);
  inside.output_begin = 20.25;
  inside.output_rest = 9.75;
  const WarpCurve curve(inside);
  EXPECT_NEAR(curve.output_frame(30.0), from_zero.output_frame(30.0) + 20.25, kRounding);
  EXPECT_NEAR(curve.input_frame(curve.output_frame(12.3)), 12.3, kRounding);
}

TEST(InverseCorrespondence, IsThatOfTheOutput) {
  const Correspondence there = wavy(90, 120.0);
  const Correspondence back = inverse(there);
  ASSERT_EQ(back.differential_warp.size(), 120);
  EXPECT_NEAR(back.differential_warp.sum(), 90.0, kRounding);
  const Correspondence again = inverse(back);
  EXPECT_LT((again.output_time() - there.output_time()).cwiseAbs().maxCoeff(), kInterpolation);
}

TEST(InverseCorrespondence, IsRefusedWhereEndsAreOpen) {
  Correspondence inside = wavy(60, 50.0);
  inside.output_rest = 3.0;
  EXPECT_THROW(inverse(inside), InvalidArgument);
}

TEST(WarpCurve, RefusesWhatIsNoWarp) {
  EXPECT_THROW(WarpCurve({Eigen::VectorXd()}), InvalidArgument);
  EXPECT_THROW(WarpCurve({Eigen::VectorXd::Zero(3)}), InvalidArgument);
  EXPECT_THROW(WarpCurve({Eigen::VectorXd::Constant(3, std::numeric_limits<double>::quiet_NaN())}), InvalidArgument);
}

TEST(ComposedCorrespondences, WithTheInverseAreTheIdentity) {
  const Correspondence there = wavy(90, 120.0);
  const Correspondence round_trip = compose(there, inverse(there));
  const Eigen::VectorXd even = Eigen::VectorXd::Ones(90);
  EXPECT_LT((round_trip.differential_warp - even).cwiseAbs().maxCoeff(), 2 * kInterpolation);
  EXPECT_NEAR(round_trip.differential_warp.sum(), 90.0, kRounding);
}

TEST(ComposedCorrespondences, CarryOpenEndsAlong) {
  Correspondence inside = wavy(60, 90.0);
  inside.output_begin = 20.0;
  inside.output_rest = 10.0;
  const Correspondence whole = wavy(120, 240.0, 0.0);  // even
  const Correspondence composed = compose(inside, whole);
  EXPECT_NEAR(composed.output_begin, 40.0, kRounding);
  EXPECT_NEAR(composed.output_rest, 20.0, kRounding);
  EXPECT_NEAR(composed.differential_warp.sum(), 180.0, kRounding);
}

TEST(ComposedCorrespondences, MustMeet) {
  EXPECT_THROW(compose(wavy(90, 120.0), wavy(90, 120.0)), InvalidArgument);
  EXPECT_NEAR(compose(wavy(90, 120.0), wavy(120, 70.0)).differential_warp.sum(), 70.0, kRounding);
}

}  // namespace
}  // namespace strut::align
