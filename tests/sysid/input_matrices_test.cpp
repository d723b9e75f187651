// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/input_matrices.h>

namespace strut::sysid {
namespace {

constexpr double kRecovered = 1e-9;  // of B and D of size one, from exact data and the true A and C

TEST(FitInputMatrices, FindsBAndDWithTheInitialStateProjectedOut) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 5, .frames = 30, .initial_state = 10.0});
  const LtiSystem found = fit_input_matrices(truth.a(), truth.c(), clips);
  EXPECT_LT((found.b() - truth.b()).norm(), kRecovered);
  EXPECT_LT((found.d() - truth.d()).norm(), kRecovered);
}

TEST(FitInputMatrices, TakesALongLeadInForKnowingTheState) {
  const LtiSystem truth = test::known_system();
  auto clips = test::clips_of(truth, {.count = 5, .frames = 30, .lead_in = 40});
  for (Experiment& clip : clips) clip.output.topRows(clip.lead_in).setConstant(1e3);  // must not be looked at
  const LtiSystem found = fit_input_matrices(truth.a(), truth.c(), clips);
  EXPECT_LT((found.b() - truth.b()).norm(), kRecovered);
}

TEST(FitInputMatrices, OfNoStatesIsLeastSquares) {
  std::mt19937 random(2);
  const Experiment clip{test::white_noise(50, 3, random), test::white_noise(50, 2, random)};
  const LtiSystem found = fit_input_matrices(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(2, 0), {clip});
  const Eigen::MatrixXd normal = clip.input.transpose() * clip.input;
  const Eigen::MatrixXd expected = normal.inverse() * clip.input.transpose() * clip.output;
  EXPECT_LT((found.d().transpose() - expected).norm(), kRecovered);
}

TEST(FitInputMatrices, GivesAnInputThatNeverMovesNothing) {
  const LtiSystem truth = test::known_system();
  auto clips = test::clips_of(truth, {.count = 5, .frames = 30});
  for (Experiment& clip : clips) clip.input.col(0).setZero();
  const LtiSystem found = fit_input_matrices(truth.a(), truth.c(), clips);
  EXPECT_EQ(found.b().col(0).norm(), 0.0);
  EXPECT_EQ(found.d().col(0).norm(), 0.0);
}

TEST(FitInputMatrices, RefusesMatricesThatDoNotFit) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 1});
  EXPECT_THROW(fit_input_matrices(truth.a(), truth.c().leftCols(2), clips), InvalidArgument);
  EXPECT_THROW(fit_input_matrices(truth.a(), truth.c().topRows(2), clips), InvalidArgument);
  EXPECT_THROW(fit_input_matrices(truth.a(), truth.c(), {}), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
