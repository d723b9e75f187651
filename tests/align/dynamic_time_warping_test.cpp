// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/align/dynamic_time_warping.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kRounding = 1e-9;  // distances come from a matrix product: relative to sums of squares of size 1..100

double distance(const FrameMatrix& p, const FrameMatrix& q, const FramePair& pair) {
  return (p.row(pair.input) - q.row(pair.output)).squaredNorm();
}

double cost_of(const FrameMatrix& p, const FrameMatrix& q, const std::vector<FramePair>& path) {
  double cost = 2.0 * distance(p, q, path.front());
  for (std::size_t k = 1; k < path.size(); ++k) {
    const int passed = path[k].input - path[k - 1].input + path[k].output - path[k - 1].output;
    cost += passed * distance(p, q, path[k]);
  }
  return cost;
}

/// The least cost over every path that takes the steps.
double brute_force(const FrameMatrix& p, const FrameMatrix& q, const std::vector<FramePair>& steps) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<FramePair> path{{0, 0}};
  const std::function<void()> extend = [&] {
    const FramePair at = path.back();
    if (at.input + 1 == p.rows() && at.output + 1 == q.rows()) least = std::min(least, cost_of(p, q, path));
    for (const FramePair& step : steps) {
      const FramePair next{at.input + step.input, at.output + step.output};
      if (next.input >= p.rows() || next.output >= q.rows()) continue;
      path.push_back(next);
      extend();
      path.pop_back();
    }
  };
  extend();
  return least;
}

struct Case {
  LocalConstraint constraint;
  std::vector<FramePair> steps;
  int input, output;
};

class DynamicTimeWarpingOracle : public testing::TestWithParam<Case> {};

TEST_P(DynamicTimeWarpingOracle, FindsTheLeastCostOfAllPaths) {
  const Case& c = GetParam();
  for (unsigned seed = 0; seed < 8; ++seed) {
    const FrameMatrix p = test::noise(c.input, 2, seed), q = test::noise(c.output, 2, seed + 100);
    const auto result = dynamic_time_warping(p, q, c.constraint);
    EXPECT_NEAR(result.cost, brute_force(p, q, c.steps), kRounding) << "seed " << seed;
    EXPECT_NEAR(result.cost, cost_of(p, q, result.path), kRounding) << "seed " << seed;
    EXPECT_EQ(result.path.front(), (FramePair{0, 0}));
    EXPECT_EQ(result.path.back(), (FramePair{c.input - 1, c.output - 1}));
    for (std::size_t k = 1; k < result.path.size(); ++k) {
      const FramePair step{result.path[k].input - result.path[k - 1].input,
                           result.path[k].output - result.path[k - 1].output};
      EXPECT_NE(std::find(c.steps.begin(), c.steps.end(), step), c.steps.end());
    }
  }
}

const std::vector<FramePair> kTypeISteps{{1, 0}, {1, 1}, {0, 1}};
const std::vector<FramePair> kTypeIIISteps{{2, 1}, {1, 1}, {1, 2}};

INSTANTIATE_TEST_SUITE_P(TypeI, DynamicTimeWarpingOracle,
                         testing::Values(Case{LocalConstraint::kTypeI, kTypeISteps, 5, 5},
                                         Case{LocalConstraint::kTypeI, kTypeISteps, 7, 3},
                                         Case{LocalConstraint::kTypeI, kTypeISteps, 1, 4},
                                         Case{LocalConstraint::kTypeI, kTypeISteps, 1, 1}));
INSTANTIATE_TEST_SUITE_P(TypeIII, DynamicTimeWarpingOracle,
                         testing::Values(Case{LocalConstraint::kTypeIII, kTypeIIISteps, 9, 9},
                                         Case{LocalConstraint::kTypeIII, kTypeIIISteps, 11, 6},
                                         Case{LocalConstraint::kTypeIII, kTypeIIISteps, 5, 8},
                                         Case{LocalConstraint::kTypeIII, kTypeIIISteps, 1, 1}));

RC_GTEST_PROP(DynamicTimeWarping, GivesEveryInputFrameAShareOfTheOutput, ()) {
  const int m = *rc::gen::inRange(2, 40);
  const int n = *rc::gen::inRange(m / 2 + 1, 2 * m);
  const auto seed = *rc::gen::inRange(0U, 100000U);
  for (const auto constraint : {LocalConstraint::kTypeI, LocalConstraint::kTypeIII}) {
    const auto result = dynamic_time_warping(test::noise(m, 2, seed), test::noise(n, 2, seed + 1), constraint);
    const Eigen::VectorXd& w = result.correspondence.differential_warp;
    RC_ASSERT(w.minCoeff() > 0.0);
    RC_ASSERT(std::abs(w.sum() - n) < kRounding);
    if (constraint == LocalConstraint::kTypeIII) {
      RC_ASSERT(w.maxCoeff() <= 2.0 + kRounding);
      RC_ASSERT(w.minCoeff() >= 0.5 - kRounding);
    }
  }
}

TEST(DynamicTimeWarping, OfASignalWithItselfIsTheIdentity) {
  const FrameMatrix signal = test::smooth_curves(80, 3, 2);
  for (const auto constraint : {LocalConstraint::kTypeI, LocalConstraint::kTypeIII}) {
    const auto result = dynamic_time_warping(signal, signal, constraint);
    EXPECT_NEAR(result.cost, 0.0, kRounding);
    EXPECT_EQ(result.correspondence.differential_warp, Eigen::VectorXd::Ones(80));
  }
}

TEST(DynamicTimeWarping, TypeIIIRefusesLengthsThatDifferTooMuch) {
  const FrameMatrix five = FrameMatrix::Zero(5, 1);
  EXPECT_NO_THROW(dynamic_time_warping(five, FrameMatrix::Zero(9, 1), LocalConstraint::kTypeIII));
  EXPECT_THROW(dynamic_time_warping(five, FrameMatrix::Zero(10, 1), LocalConstraint::kTypeIII), InvalidArgument);
  EXPECT_THROW(dynamic_time_warping(five, FrameMatrix::Zero(2, 1), LocalConstraint::kTypeIII), InvalidArgument);
  EXPECT_NO_THROW(dynamic_time_warping(five, FrameMatrix::Zero(40, 1), LocalConstraint::kTypeI));
}

TEST(DynamicTimeWarping, WeighsDegreesOfFreedom) {
  FrameMatrix input = test::smooth_curves(60, 3, 4), output = test::smooth_curves(70, 3, 9);
  DynamicTimeWarpingOptions options;
  options.weights = Eigen::Vector3d(1.0, 2.0, 0.0);
  const auto found = dynamic_time_warping(input, output, LocalConstraint::kTypeIII, options);
  FrameMatrix scaled_input = input.leftCols(2), scaled_output = output.leftCols(2);
  scaled_input.col(1) *= std::sqrt(2.0);
  scaled_output.col(1) *= std::sqrt(2.0);
  EXPECT_EQ(found.path, dynamic_time_warping(scaled_input, scaled_output, LocalConstraint::kTypeIII).path);
}

TEST(DynamicTimeWarping, CoarseToFineOfSmoothSignalsIsTheBestOfAll) {
  for (const auto constraint : {LocalConstraint::kTypeI, LocalConstraint::kTypeIII}) {
    const FrameMatrix input = test::smooth_curves(500, 5, 1), output = test::smooth_curves(620, 5, 1);
    const auto exact = dynamic_time_warping(input, output, constraint);
    const auto found = dynamic_time_warping(input, output, constraint, {.exact_cells = 5000, .band_radius = 40});
    EXPECT_TRUE(exact.is_exact);
    EXPECT_FALSE(found.is_exact);
    EXPECT_EQ(found.path, exact.path);
  }
}

RC_GTEST_PROP(DynamicTimeWarping, CoarseToFineAlwaysFindsAPathAndNeverABetter, ()) {
  const int m = *rc::gen::inRange(64, 200);
  const int n = *rc::gen::element((m - 1) / 2 + 2, 2 * m - 1, *rc::gen::inRange(m / 2 + 2, 2 * m));
  const auto seed = *rc::gen::inRange(0U, 100000U);
  const FrameMatrix input = test::noise(m, 2, seed), output = test::noise(n, 2, seed + 1);
  const DynamicTimeWarpingOptions options{.exact_cells = 1, .band_radius = *rc::gen::inRange(1, 10)};
  for (const auto constraint : {LocalConstraint::kTypeI, LocalConstraint::kTypeIII}) {
    const auto found = dynamic_time_warping(input, output, constraint, options);
    RC_ASSERT(std::abs(found.cost - cost_of(input, output, found.path)) < kRounding * found.cost);
    RC_ASSERT(found.cost >= dynamic_time_warping(input, output, constraint).cost * (1.0 - kRounding));
  }
}

TEST(DynamicTimeWarping, RefusesOptionsOutOfRange) {
  const FrameMatrix signal = test::noise(10, 2, 1);
  const auto refuses = [&](const DynamicTimeWarpingOptions& options) {
    EXPECT_THROW(dynamic_time_warping(signal, signal, LocalConstraint::kTypeI, options), InvalidArgument);
  };
  refuses({.weights = Eigen::VectorXd::Zero(2)});
  refuses({.weights = -Eigen::VectorXd::Ones(2)});
  refuses({.weights = Eigen::VectorXd::Ones(3)});
  refuses({.exact_cells = 0});
  refuses({.band_radius = 0});
}

TEST(DynamicTimeWarping, RefusesNaN) {
  FrameMatrix bad = FrameMatrix::Zero(5, 1);
  bad(2, 0) = std::nan("");
  EXPECT_THROW(dynamic_time_warping(bad, bad, LocalConstraint::kTypeI), InvalidArgument);
}

}  // namespace
}  // namespace strut::align
