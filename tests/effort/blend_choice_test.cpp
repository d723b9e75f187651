// SPDX-License-Identifier: MIT
#include "small_effort.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/blend_choice.h>
#include <strut/effort/descriptors.h>

namespace strut::effort {
namespace {

using test::kLifts;
using test::kReaches;

class BlendChoice : public testing::Test {
 protected:
  static const BlendChooser& chooser() {
    static const BlendChooser chooser(test::small_effort_model());
    return chooser;
  }
  static EffortVector only_time(double time) { return {kNotRated, kNotRated, time}; }
};

TEST_F(BlendChoice, ComesNearerThanAnyFragment) {
  ChoiceOptions by_equation;
  by_equation.num_candidates = 1;
  for (const EffortVector& wanted : {EffortVector(0.2, -0.3, 0.5), EffortVector(-0.6, 0.4, 0.0)}) {
    const ChosenBlend fragment = chooser().choose_fragment(kReaches, wanted);
    const ChosenBlend blend = chooser().choose(kReaches, wanted, by_equation);
    EXPECT_LT((blend.predicted - wanted).norm(), (fragment.predicted - wanted).norm());
    EXPECT_NEAR(blend.error, (blend.predicted - wanted).norm(), 1e-12);
    EXPECT_EQ(fragment.first, fragment.second);
    EXPECT_EQ(fragment.predicted, chooser().model().fragment(fragment.first).effort);
  }
}

TEST_F(BlendChoice, FollowsTheEquation) {
  ChoiceOptions by_equation;
  by_equation.num_candidates = 1;
  const EffortVector wanted(0.1, 0.2, 0.3);
  const ChosenBlend chosen = chooser().choose(kLifts, wanted, by_equation);
  double best = 1e9;
  const Eigen::VectorXd alphas = Eigen::VectorXd::LinSpaced(41, -0.5, 1.5);
  for (const FragmentPair& pair : chooser().model().parts().pairs) {
    if (chooser().model().fragment(pair.first).group != kLifts) continue;
    for (const auto& predicted : chooser().model().parts().regression.predict(pair.first, pair.second, alphas)) {
      best = std::min(best, (predicted.effort - wanted).norm());
    }
  }
  constexpr double kGrid = 0.03;  // the pair is searched on a coarse grid first
  EXPECT_LT(chosen.error, best + kGrid);
}

TEST_F(BlendChoice, SecondLookCountsHowItMoves) {
  const ChosenBlend chosen = chooser().choose(kReaches, {0.0, 0.0, 0.8});
  EXPECT_TRUE(is_rated(chosen.estimated[kTime]));
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    const auto [low, high] = std::minmax(chosen.predicted[factor], chosen.estimated[factor]);
    EXPECT_GE(chosen.expected[factor], low - 1e-12);
    EXPECT_LE(chosen.expected[factor], high + 1e-12);
  }
  const EffortPrediction again = chooser().estimate(chooser().synthesize(chosen).motion, kReaches);
  EXPECT_EQ(again.effort, chosen.estimated);
}

TEST_F(BlendChoice, ForgetsWhatWasAskedBefore) {
  const BlendChooser fresh(test::small_effort_model());
  const ChosenBlend a = chooser().choose(kReaches, {0.5, 0.5, -0.5});
  const ChosenBlend b = fresh.choose(kReaches, {0.5, 0.5, -0.5});
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.second, b.second);
  EXPECT_EQ(a.alpha, b.alpha);
  EXPECT_EQ(a.error, b.error);
}

TEST_F(BlendChoice, MovesFasterWhereSuddenIsWanted) {
  const auto acceleration = [](double time) {
    const ChosenBlend chosen = chooser().choose(kReaches, only_time(time));
    return describe(chooser().synthesize(chosen).motion)[kLogAcceleration];
  };
  EXPECT_GT(acceleration(0.8), acceleration(0.0));
  EXPECT_GT(acceleration(0.0), acceleration(-0.8));
}

TEST_F(BlendChoice, TakesSingleFragmentsWhereNothingCanBeBlended) {
  EffortModelParts parts = test::small_effort_model()->parts();
  parts.pairs.clear();
  const BlendChooser single(std::make_shared<const EffortModel>(std::move(parts)));
  const ChosenBlend chosen = single.choose(kLifts, only_time(0.9));
  EXPECT_EQ(chosen.first, chosen.second);
  EXPECT_EQ(single.synthesize(chosen).motion.frames(), single.model().fragment(chosen.first).motion.frames());
}

TEST_F(BlendChoice, RefusesWhatMakesNoSense) {
  const EffortVector wanted(0.0, 0.0, 0.0);
  EXPECT_THROW(BlendChooser(nullptr), InvalidArgument);
  EXPECT_THROW((void)chooser().choose(2, wanted), InvalidArgument);
  EXPECT_THROW((void)chooser().choose(-1, wanted), InvalidArgument);
  EXPECT_THROW((void)chooser().choose(0, EffortVector::Constant(kNotRated)), InvalidArgument);
  ChoiceOptions options;
  options.weights = EffortVector::Zero();
  EXPECT_THROW((void)chooser().choose(0, wanted, options), InvalidArgument);
  options = {};
  options.num_candidates = 0;
  EXPECT_THROW((void)chooser().choose(0, wanted, options), InvalidArgument);
  options = {};
  options.least_alpha = 0.5;
  EXPECT_THROW((void)chooser().choose(0, wanted, options), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
