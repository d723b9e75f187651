// SPDX-License-Identifier: MIT
#include "small_effort.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/effort_model.h>

namespace strut::effort {
namespace {

using test::small_effort_model;

TEST(EffortModel, KnowsItsGroups) {
  const EffortModel& model = *small_effort_model();
  ASSERT_EQ(model.num_groups(), 2);
  EXPECT_EQ(model.group(test::kReaches).size(), 8U);
  for (const int i : model.group(test::kLifts)) EXPECT_EQ(model.fragment(i).group, test::kLifts);
  EXPECT_EQ(model.features(0).cols(), model.parts().space.components.cols());
  EXPECT_EQ(model.features(0).rows(), model.fragment(0).motion.num_frames());
}

TEST(EffortModel, RefusesPartsThatDoNotFit) {
  const auto refuses = [](auto change) {
    EffortModelParts parts = small_effort_model()->parts();
    change(parts);
    EXPECT_THROW(EffortModel{std::move(parts)}, InvalidArgument);
  };
  refuses([](EffortModelParts& parts) { parts.fragments.clear(); });
  refuses([](EffortModelParts& parts) { parts.fragments.pop_back(); });
  refuses([](EffortModelParts& parts) { parts.fragments[0].effort[kTime] = 1.5; });
  refuses([](EffortModelParts& parts) { parts.fragments[0].effort[kTime] += 0.01; });  // not what was learnt from
  refuses([](EffortModelParts& parts) { parts.fragments[0].group = test::kLifts; });
  refuses([](EffortModelParts& parts) { parts.fragments[0].motion = parts.fragments[0].motion.slice(0, 3); });
  refuses([](EffortModelParts& parts) { parts.pairs.push_back({3, 2}); });
  refuses([](EffortModelParts& parts) { parts.pairs.push_back({0, 15}); });
  refuses([](EffortModelParts& parts) { parts.pairs.push_back({2, 99}); });
  refuses([](EffortModelParts& parts) { parts.threshold = 0.0; });
  refuses([](EffortModelParts& parts) { parts.space.mean.conservativeResize(5); });
  refuses([](EffortModelParts& parts) { parts.upright.coeffs() *= 2.0; });
  refuses([](EffortModelParts& parts) { parts.estimator = KinematicEstimator({parts.estimator.numbers().groups[0]}); });
}

}  // namespace
}  // namespace strut::effort
