// SPDX-License-Identifier: MIT
// How labels carry over to blends: exact at the ends, symmetric, honest about what is unknown.
#include "effort/simulated_raters.h"

#include <cmath>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/effort_regression.h>

namespace strut::effort {
namespace {

using test::Simulation;

// Sums in another order.
constexpr double kRounding = 1e-9;

RegressionOptions by(RegressionMethod method) {
  RegressionOptions options;
  options.method = method;
  return options;
}

EffortPrediction at(const EffortRegression& regression, int first, int second, double alpha) {
  return regression.predict(first, second, Eigen::VectorXd::Constant(1, alpha)).front();
}

/// Over all blends, per factor.
EffortVector squared_errors(const EffortRegression& regression, const std::vector<LabelledBlend>& blends) {
  EffortVector sum = EffortVector::Zero();
  for (const LabelledBlend& blend : blends) {
    sum += (at(regression, blend.first, blend.second, blend.alpha).effort - blend.effort).cwiseAbs2();
  }
  return sum / static_cast<double>(blends.size());
}

std::string message_of(const std::vector<LabelledFragment>& fragments, const std::vector<LabelledBlend>& blends) {
  try {
    fit_effort_regression(fragments, blends);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

TEST(EffortRegression, IsExactAtTheEnds) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(60, true);
  for (const auto method :
       {RegressionMethod::kLinearLabels, RegressionMethod::kNearestEnd, RegressionMethod::kLinearPlusResidual}) {
    const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends, by(method));
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(at(regression, i, 5 - i, 0.0).effort, simulation.fragments[static_cast<std::size_t>(i)].effort);
      EXPECT_EQ(at(regression, i, 5 - i, 1.0).effort, simulation.fragments[static_cast<std::size_t>(5 - i)].effort);
    }
  }
}

TEST(EffortRegression, IsTheSameForAPairTurnedRound) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(60, true);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  for (const double alpha : {-0.5, 0.2, 0.5, 0.9, 1.4}) {
    const EffortPrediction straight = at(regression, 1, 4, alpha), turned = at(regression, 4, 1, 1.0 - alpha);
    EXPECT_TRUE(straight.effort.isApprox(turned.effort, kRounding));
    EXPECT_TRUE(straight.deviation.isApprox(turned.deviation, kRounding));
  }
}

TEST(EffortRegression, LearnsWhatLinearLabelsMiss) {
  Simulation simulation(4, 10, 0.05);
  simulation.label(200, true);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  const EffortRegression linear =
      fit_effort_regression(simulation.fragments, simulation.blends, by(RegressionMethod::kLinearLabels));
  simulation.blends.clear();
  simulation.label(200, true);
  const EffortVector learnt = squared_errors(regression, simulation.blends);
  const EffortVector baseline = squared_errors(linear, simulation.blends);
  // Linear labels overshoot where labels bend towards 1; noise of three labels is what is left.
  for (int d = 0; d < kNumPredictedFactors; ++d) EXPECT_LT(learnt[d], 0.8 * baseline[d]) << kFactorNames[d];
}

TEST(EffortRegression, StaysLinearWhereTheResidualIsNoise) {
  Simulation simulation(4, 8, 0.0);
  const auto label_linearly = [&] {
    simulation.blends.clear();
    simulation.label(120);
    std::normal_distribution<double> normal(0.0, 0.1);
    for (LabelledBlend& blend : simulation.blends) {
      const EffortVector& a = simulation.fragments[static_cast<std::size_t>(blend.first)].effort;
      const EffortVector& b = simulation.fragments[static_cast<std::size_t>(blend.second)].effort;
      blend.effort = (1.0 - blend.alpha) * a + blend.alpha * b;
      for (double& value : blend.effort) value = std::clamp(value + normal(simulation.random), -1.0, 1.0);
    }
  };
  label_linearly();
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  const EffortRegression linear = fit_effort_regression(simulation.fragments, {}, by(RegressionMethod::kLinearLabels));
  label_linearly();
  const EffortVector learnt = squared_errors(regression, simulation.blends);
  const EffortVector baseline = squared_errors(linear, simulation.blends);
  // 120 labels tell the error of a mean square to about sqrt(2 / 120) of it; what is learnt of noise must be less.
  for (int d = 0; d < kNumPredictedFactors; ++d) EXPECT_LT(learnt[d], 1.15 * baseline[d]) << kFactorNames[d];
}

TEST(EffortRegression, IntervalsCoverWhatTheyClaim) {
  Simulation simulation(4, 10, 0.1);
  simulation.label(200, true);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  simulation.blends.clear();
  simulation.label(300, true);
  constexpr double kNinety = 1.6448536;
  for (int d = 0; d < kNumPredictedFactors; ++d) {
    int inside = 0;
    for (const LabelledBlend& blend : simulation.blends) {
      const EffortPrediction found = at(regression, blend.first, blend.second, blend.alpha);
      inside += std::abs(found.effort[d] - blend.effort[d]) <= kNinety * found.deviation[d] ? 1 : 0;
    }
    // A share of 300 has a deviation of 0.017; blends share fragments and with them their labels' errors.
    EXPECT_NEAR(inside / 300.0, 0.9, 0.08) << kFactorNames[d];
  }
}

TEST(EffortRegression, LabelsAtEndsAreNoMoreCertainThanTheRater) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(80);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  EXPECT_GT(at(regression, 0, 1, 0.0).deviation.minCoeff(), 0.03);
}

TEST(EffortRegression, WithoutLabelledBlendsIsLinearAndSaysSo) {
  const Simulation simulation(2, 5, 0.1);
  Diagnostics diagnostics;
  const EffortRegression regression = fit_effort_regression(simulation.fragments, {}, {}, &diagnostics);
  const EffortPrediction found = at(regression, 0, 1, 0.25);
  const EffortVector expected = 0.75 * simulation.fragments[0].effort + 0.25 * simulation.fragments[1].effort;
  EXPECT_TRUE(found.effort.isApprox(expected, kRounding));
  EXPECT_GT(found.deviation.minCoeff(), 0.1);
  ASSERT_EQ(diagnostics.entries().size(), 1U);
  EXPECT_NE(diagnostics.entries()[0].message.find("no labelled blend of flow, weight, time"), std::string::npos);
}

TEST(EffortRegression, SkipsAFactorThatWasLeftOut) {
  Simulation simulation(3, 6, 0.05);
  simulation.label(60);
  std::vector<LabelledBlend> without = simulation.blends;
  for (LabelledBlend& blend : without) blend.effort[kWeight] = kNotRated;
  simulation.fragments[0].effort[kTime] = kNotRated;
  const EffortRegression regression = fit_effort_regression(simulation.fragments, without);
  const EffortPrediction unrated = at(regression, 0, 1, 0.5);
  EXPECT_FALSE(is_rated(unrated.effort[kTime]));
  EXPECT_FALSE(is_rated(unrated.deviation[kTime]));
  EXPECT_TRUE(is_rated(unrated.effort[kFlow]));
  EXPECT_NEAR(unrated.effort[kWeight],
              0.5 * (simulation.fragments[0].effort[kWeight] + simulation.fragments[1].effort[kWeight]), kRounding);
}

TEST(EffortRegression, PredictsManyPairsAsItPredictsOne) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(90, true);
  std::vector<FragmentPair> pairs;
  for (int i = 0; i < 18; ++i) {
    for (int j = 0; j < 18; ++j) pairs.push_back({i, j});
  }
  const Eigen::VectorXd alphas = Eigen::VectorXd::LinSpaced(9, -0.5, 1.5);
  for (const auto method : {RegressionMethod::kLinearPlusResidual, RegressionMethod::kSupportVector}) {
    const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends, by(method));
    const auto tables = regression.predict(pairs, alphas);
    for (const std::size_t p : {0U, 70U, 200U, 323U}) {
      const auto one = regression.predict(pairs[p].first, pairs[p].second, alphas);
      for (int d = 0; d < kNumPredictedFactors; ++d) {
        for (int q = 0; q < 9; ++q) {
          EXPECT_NEAR(tables[static_cast<std::size_t>(d)](static_cast<Eigen::Index>(p), q),
                      one[static_cast<std::size_t>(q)].effort[d], kRounding);
        }
      }
    }
  }
}

TEST(EffortRegression, ComesBackFromItsNumbers) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(60);
  for (const auto method : {RegressionMethod::kLinearPlusResidual, RegressionMethod::kSupportVector}) {
    const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends, by(method));
    const EffortRegression again(regression.parts());
    EXPECT_EQ(at(regression, 0, 3, 0.4).effort, at(again, 0, 3, 0.4).effort);
  }
}

TEST(EffortRegression, IsTheSameEveryTime) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(60);
  const EffortRegression one = fit_effort_regression(simulation.fragments, simulation.blends);
  const EffortRegression other = fit_effort_regression(simulation.fragments, simulation.blends);
  EXPECT_EQ(at(one, 2, 3, 0.3).effort, at(other, 2, 3, 0.3).effort);
  EXPECT_EQ(at(one, 2, 3, 0.3).deviation, at(other, 2, 3, 0.3).deviation);
}

TEST(EffortRegression, AveragesRaters) {
  const double nothing = kNotRated;
  const EffortVector mean = mean_rating({{0.2, nothing, nothing}, {0.4, -0.5, nothing}});
  EXPECT_DOUBLE_EQ(mean[0], 0.3);
  EXPECT_DOUBLE_EQ(mean[1], -0.5);
  EXPECT_FALSE(is_rated(mean[2]));
}

TEST(EffortRegression, ABlendOfAFragmentWithItselfIsTheFragment) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(60);
  RegressionOptions options;
  const EffortRegression regression = fit_effort_regression(simulation.fragments, {}, options);
  EXPECT_TRUE(at(regression, 2, 2, 0.5).effort.isApprox(simulation.fragments[2].effort, kRounding));
}

TEST(EffortRegression, RefusesWhatItCannotLearnFrom) {
  Simulation simulation(2, 4, 0.1);
  simulation.label(10);
  const auto& fragments = simulation.fragments;
  EXPECT_NE(message_of({}, {}).find("fragments"), std::string::npos);
  auto broken = fragments;
  broken[2].features(0, 0) = std::nan("");
  EXPECT_NE(message_of(broken, {}).find("fragment 2"), std::string::npos);
  broken = fragments;
  broken[1].features.resize(0, 6);
  EXPECT_NE(message_of(broken, {}).find("fragment 1"), std::string::npos);
  broken = fragments;
  broken[3].effort[kTime] = 1.5;
  EXPECT_NE(message_of(broken, {}).find("time"), std::string::npos);
  EXPECT_NE(message_of(fragments, {{0, 8, 0.5, EffortVector::Zero()}}).find("blend 0"), std::string::npos);
  EXPECT_NE(message_of(fragments, {{0, 7, 0.5, EffortVector::Zero()}}).find("one group"), std::string::npos);
  EXPECT_NE(message_of(fragments, {{0, 1, 3.5, EffortVector::Zero()}}).find("alpha"), std::string::npos);
  EXPECT_NE(message_of(fragments, {{0, 1, std::nan(""), EffortVector::Zero()}}).find("alpha"), std::string::npos);
}

TEST(EffortRegression, RefusesToPredictWhatIsNoBlend) {
  const Simulation simulation(1, 3, 0.1);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, {});
  EXPECT_THROW(at(regression, 0, 3, 0.5), InvalidArgument);
  EXPECT_THROW(at(regression, -1, 1, 0.5), InvalidArgument);
  EXPECT_THROW(at(regression, 0, 1, 4.0), InvalidArgument);
  EXPECT_THROW(static_cast<void>(regression.predict(std::vector<FragmentPair>{{0, 9}}, Eigen::VectorXd::Zero(1))),
               InvalidArgument);
}

TEST(EffortRegression, RefusesBrokenNumbers) {
  Simulation simulation(2, 4, 0.1);
  simulation.label(20);
  const EffortRegressionParts good = fit_effort_regression(simulation.fragments, simulation.blends).parts();
  const auto refuses = [&](auto&& change) {
    EffortRegressionParts parts = good;
    change(parts);
    EXPECT_THROW(EffortRegression{parts}, InvalidArgument);
  };
  refuses([](EffortRegressionParts& parts) { parts.blends[0].first = 8; });
  refuses([](EffortRegressionParts& parts) { parts.duration[0] = 0.0; });
  refuses([](EffortRegressionParts& parts) { parts.posture.conservativeResize(3, Eigen::NoChange); });
  refuses([](EffortRegressionParts& parts) { parts.curves(0, 0) = std::nan(""); });
  refuses([](EffortRegressionParts& parts) { parts.residual[1].noise = 0.0; });
  refuses([](EffortRegressionParts& parts) { parts.effort(0, 0) = 2.0; });
}

}  // namespace
}  // namespace strut::effort
