// SPDX-License-Identifier: MIT
// Cross-validation judges what was not learnt from, beside the baselines.
#include "effort/simulated_raters.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/effort_validation.h>

namespace strut::effort {
namespace {

using test::Simulation;

constexpr double kRounding = 1e-12;

ValidationOptions only(RegressionMethod method) {
  ValidationOptions options;
  options.methods = {method};
  return options;
}

TEST(EffortValidation, LinearLabelsAreJudgedAsByHand) {
  Simulation simulation(2, 8, 0.1);
  simulation.label(80);
  const ValidationResult found = cross_validate(simulation.fragments, simulation.blends, ValidationSplit::kAction,
                                                only(RegressionMethod::kLinearLabels));
  double sum = 0.0;
  for (const LabelledBlend& blend : simulation.blends) {
    const double a = simulation.fragments[static_cast<std::size_t>(blend.first)].effort[kTime];
    const double b = simulation.fragments[static_cast<std::size_t>(blend.second)].effort[kTime];
    const double error = (1.0 - blend.alpha) * a + blend.alpha * b - blend.effort[kTime];
    sum += error * error / 80.0;
  }
  EXPECT_NEAR(found.methods[0].error[kTime], std::sqrt(sum), kRounding);
  EXPECT_EQ(found.num_judged[kTime], 80);
  EXPECT_EQ(found.num_parts, 2);
  EXPECT_EQ(found.num_straddling, 0);
}

TEST(EffortValidation, BlendsThatStraddleAreNotJudged) {
  Simulation simulation(1, 8, 0.0);
  // Fragments 0 and 4 share a part of four, 0 and 1 do not.
  simulation.blends = {{0, 4, 0.5, EffortVector::Zero()}, {0, 1, 0.5, EffortVector::Zero()}};
  const ValidationResult found = cross_validate(simulation.fragments, simulation.blends, ValidationSplit::kFragment,
                                                only(RegressionMethod::kNearestEnd));
  EXPECT_EQ(found.num_judged, Eigen::Vector3i::Constant(1));
  EXPECT_EQ(found.num_straddling, 1);
}

TEST(EffortValidation, FactorsThatWereLeftOutAreNotJudged) {
  Simulation simulation(3, 6, 0.1);
  simulation.label(60);
  for (LabelledBlend& blend : simulation.blends) blend.effort[kWeight] = kNotRated;
  const ValidationResult found = cross_validate(simulation.fragments, simulation.blends, ValidationSplit::kAction,
                                                only(RegressionMethod::kLinearLabels));
  EXPECT_FALSE(is_rated(found.methods[0].error[kWeight]));
  EXPECT_NEAR(found.methods[0].mean_error, 0.5 * (found.methods[0].error[kFlow] + found.methods[0].error[kTime]),
              kRounding);
  EXPECT_EQ(found.num_judged[kWeight], 0);
}

TEST(EffortValidation, NamesTheBestBaseline) {
  Simulation simulation(3, 6, 0.05);
  simulation.label(60);
  const ValidationResult found = cross_validate(simulation.fragments, simulation.blends, ValidationSplit::kAction);
  ASSERT_NE(found.best_baseline(), nullptr);
  EXPECT_EQ(found.best_baseline()->method, RegressionMethod::kLinearLabels);
  EXPECT_FALSE(is_rated(found.find(RegressionMethod::kSupportVector)->coverage[0]));
  EXPECT_GT(found.find(RegressionMethod::kLinearPlusResidual)->coverage[0], 0.7);
}

TEST(EffortValidation, LeavesPerformersOut) {
  Simulation simulation(2, 8, 0.1);
  simulation.label(60);
  std::vector<int> performers;
  for (int i = 0; i < 16; ++i) performers.push_back(i % 2);
  const ValidationResult found = cross_validate(simulation.fragments, simulation.blends, ValidationSplit::kPerformer,
                                                only(RegressionMethod::kLinearLabels), performers);
  const auto together = std::count_if(simulation.blends.begin(), simulation.blends.end(),
                                      [](const LabelledBlend& blend) { return (blend.first + blend.second) % 2 == 0; });
  EXPECT_EQ(found.num_judged[kFlow], together);
  EXPECT_EQ(found.num_straddling, 60 - together);
}

TEST(EffortValidation, WithNothingToJudgeSaysSo) {
  const Simulation simulation(1, 4, 0.1);
  const ValidationResult found = cross_validate(simulation.fragments, {}, ValidationSplit::kAction);
  EXPECT_EQ(found.best_baseline(), nullptr);
  EXPECT_FALSE(is_rated(found.methods[0].mean_error));
}

TEST(EffortValidation, RefusesWhatItCannotSplit) {
  const Simulation simulation(1, 4, 0.1);
  EXPECT_THROW(cross_validate(simulation.fragments, {}, ValidationSplit::kPerformer), InvalidArgument);
  EXPECT_THROW(cross_validate({}, {}, ValidationSplit::kAction), InvalidArgument);
  ValidationOptions options;
  options.num_folds = 1;
  EXPECT_THROW(cross_validate(simulation.fragments, {}, ValidationSplit::kFragment, options), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
