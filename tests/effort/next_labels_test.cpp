// SPDX-License-Identifier: MIT
// Active labelling asks where a label lowers the expected error of all blends the most.
#include "effort/simulated_raters.h"

#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/next_labels.h>

namespace strut::effort {
namespace {

using test::Simulation;

std::vector<FragmentPair> all_pairs(const Simulation& simulation) {
  std::vector<FragmentPair> pairs;
  const int count = static_cast<int>(simulation.fragments.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const auto group = [&](int k) { return simulation.fragments[static_cast<std::size_t>(k)].group; };
      if (group(i) == group(j)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

/// Mean variance of all candidates' residuals over the factors.
double mean_variance(const EffortRegression& regression, const std::vector<LabelledBlend>& candidates) {
  double sum = 0.0;
  for (int d = 0; d < kNumPredictedFactors; ++d) {
    sum += regression.covariance(candidates, static_cast<Factor>(d)).trace() / static_cast<double>(candidates.size());
  }
  return sum;
}

EffortRegression with_more(const EffortRegression& regression, const std::vector<LabelledBlend>& more) {
  EffortRegressionParts parts = regression.parts();
  for (LabelledBlend blend : more) {
    blend.effort.setZero();
    parts.blends.push_back(blend);
  }
  return EffortRegression(std::move(parts));
}

TEST(NextLabels, GainIsTheVarianceThatALabelTakesAway) {
  Simulation simulation(2, 6, 0.1);
  simulation.label(20);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  const auto candidates = candidate_blends(regression, all_pairs(simulation));
  NextLabelOptions options;
  options.count = 3;
  double before = mean_variance(regression, candidates);
  std::vector<LabelledBlend> added;
  for (const SuggestedBlend& found : next_labels(regression, candidates, options)) {
    added.push_back({found.first, found.second, found.alpha});
    const double after = mean_variance(with_more(regression, added), candidates);
    // By refitting from scratch, another way than rank-one updates.
    EXPECT_NEAR(found.gain, before - after, 1e-9);
    before = after;
  }
}

TEST(NextLabels, TheFirstIsTheBestOfAll) {
  Simulation simulation(2, 5, 0.1);
  simulation.label(12);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  const auto candidates = candidate_blends(regression, all_pairs(simulation));
  NextLabelOptions options;
  options.count = 1;
  const auto found = next_labels(regression, candidates, options);
  ASSERT_EQ(found.size(), 1U);
  const double before = mean_variance(regression, candidates);
  for (const LabelledBlend& blend : candidates) {
    EXPECT_LE(before - mean_variance(with_more(regression, {blend}), candidates), found[0].gain + 1e-9);
  }
}

TEST(NextLabels, SpreadsOverGroupsAndPairs) {
  Simulation simulation(4, 6, 0.1);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, {});
  NextLabelOptions options;
  options.count = 12;
  const auto found = next_labels(regression, candidate_blends(regression, all_pairs(simulation)), options);
  ASSERT_EQ(found.size(), 12U);
  std::map<int, int> groups;
  std::set<std::pair<int, int>> pairs;
  for (const SuggestedBlend& blend : found) {
    ++groups[simulation.fragments[static_cast<std::size_t>(blend.first)].group];
    pairs.insert({blend.first, blend.second});
    EXPECT_GT(blend.gain, 0.0);
  }
  EXPECT_EQ(pairs.size(), 12U);
  for (const auto& [group, count] : groups) EXPECT_LE(count, 6) << group;
}

TEST(NextLabels, DoesNotAskAgain) {
  Simulation simulation(1, 4, 0.1);
  simulation.blends = {{1, 0, 0.75, EffortVector::Zero()}};
  const EffortRegression regression = fit_effort_regression(simulation.fragments, simulation.blends);
  for (const LabelledBlend& blend : candidate_blends(regression, {{0, 1}})) EXPECT_NE(blend.alpha, 0.25);
  EXPECT_EQ(candidate_blends(regression, {{0, 1}}).size(), 4U);
}

TEST(NextLabels, HasNothingToAskWithoutAVariance) {
  Simulation simulation(1, 4, 0.1);
  RegressionOptions linear;
  linear.method = RegressionMethod::kLinearLabels;
  const EffortRegression regression = fit_effort_regression(simulation.fragments, {}, linear);
  EXPECT_TRUE(next_labels(regression, candidate_blends(regression, {{0, 1}})).empty());
  EXPECT_TRUE(next_labels(regression, {}).empty());
}

TEST(NextLabels, RefusesOptionsOutOfRange) {
  const Simulation simulation(1, 4, 0.1);
  const EffortRegression regression = fit_effort_regression(simulation.fragments, {});
  NextLabelOptions options;
  options.count = 0;
  EXPECT_THROW(next_labels(regression, {}, options), InvalidArgument);
  EXPECT_THROW(candidate_blends(regression, {{0, 4}}), InvalidArgument);
  EXPECT_THROW(next_labels(regression, {{0, 7, 0.5}}), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
