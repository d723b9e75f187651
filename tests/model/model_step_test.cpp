// SPDX-License-Identifier: MIT
#include "support/allocations.h"
#include "support/small_model.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <strut/model/model_step.h>
#include <strut/representation/normalization.h>

namespace strut {
namespace {

Eigen::RowVectorXd some_row(int size, int frame) {
  Eigen::RowVectorXd row(size);
  for (int i = 0; i < size; ++i) row[i] = std::sin(0.3 * frame + i);
  return row;
}

TEST(ModelStep, StateIsThatOfAllBlocksInTheirOrder) {
  StyleModelParts parts = test::copying_parts(test::turning_motion(30.0, 1.0));
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  parts.blocks[3].system = sysid::LtiSystem(0.5 * one, one, one, one);
  parts.blocks[5].system = sysid::LtiSystem(0.9 * one, one, one, one);
  const auto model = std::make_shared<const StyleModel>(std::move(parts));
  ASSERT_EQ(model->state_size(), 2);
  ModelStep<double> step(model);
  Eigen::RowVectorXd output(model->num_dofs() + 1);
  Eigen::Vector2d expected = Eigen::Vector2d::Zero(), state;
  for (int frame = 0; frame < 10; ++frame) {
    const Eigen::RowVectorXd input = some_row(model->num_dofs(), frame);
    step.step(input, output);
    const Eigen::RowVectorXd u = model->input_scaling().normalize(FrameMatrix(input)).row(0);
    expected[0] = 0.5 * expected[0] + u[model->blocks()[3].input_dofs[0]];
    expected[1] = 0.9 * expected[1] + u[model->blocks()[5].input_dofs[0]];
    step.state(state);
    EXPECT_LT((state - expected).norm(), 1e-12) << frame;
  }
  step.reset();
  step.state(state);
  EXPECT_EQ(state.norm(), 0.0);
}

TEST(ModelStep, StateOfARadialMapIsTheContextsAtEveryLag) {
  const auto model = std::make_shared<const StyleModel>(test::radial_parts(test::turning_motion(30.0, 1.0)));
  const auto& lags = model->radial_map()->lags;
  const Eigen::Index contexts = model->context().rows();
  ASSERT_EQ(model->state_size(), static_cast<int>(contexts) * static_cast<int>(lags.size()));
  ModelStep<double> step(model);
  Eigen::RowVectorXd output(model->num_dofs() + 1);
  Eigen::VectorXd state(model->state_size());
  std::vector<Eigen::VectorXd> newest;
  for (int frame = 0; frame < 10; ++frame) {
    step.step(some_row(model->num_dofs(), frame), output);
    step.state(state);
    newest.emplace_back(state.head(contexts));
    // Before the first frame the body is taken to have stood.
    const Eigen::VectorXd& older = newest[static_cast<std::size_t>(std::max(0, frame - lags.back()))];
    EXPECT_EQ(Eigen::VectorXd(state.tail(contexts)), older) << frame;
  }
  EXPECT_EQ(test::count_allocations([&] { step.state(state); }), 0);
}

constexpr double kRounding = 1e-12;  // of a few numbers of order one

/// Deviations of the copying model's input: what the examples have, by degree of freedom.
ModelStep<double> step_with(const Eigen::VectorXd& mean, const Eigen::VectorXd& scale) {
  StyleModelParts parts = test::copying_parts(test::turning_motion(30.0, 1.0));
  parts.input_scaling = {mean, scale};
  return ModelStep<double>(std::make_shared<const StyleModel>(std::move(parts)));
}

double deviation(ModelStep<double> step, const Eigen::RowVectorXd& row) {
  Eigen::RowVectorXd output(row.size() + 1);
  step.step(row, output);
  return step.largest_deviation();
}

class LargestDeviation : public testing::Test {
 protected:
  const int dofs_ = test::copying_parts(test::turning_motion(30.0, 1.0)).input.num_dofs();
  Eigen::VectorXd mean_ = Eigen::VectorXd::LinSpaced(dofs_, -0.5, 0.5);
  Eigen::VectorXd scale_ = Eigen::VectorXd::Constant(dofs_, 0.5);
};

TEST_F(LargestDeviation, IsZeroAtTheMeanAndBeforeTheFirstStep) {
  EXPECT_EQ(step_with(mean_, scale_).largest_deviation(), 0.0);
  EXPECT_EQ(deviation(step_with(mean_, scale_), mean_.transpose()), 0.0);
}

TEST_F(LargestDeviation, IsThatOfTheDegreeOfFreedomFarthestOff) {
  for (int dof = 0; dof < dofs_; ++dof) {
    Eigen::RowVectorXd row = mean_.transpose().array() + 0.3;
    row[dof] = mean_[dof] - 1.0;
    EXPECT_NEAR(deviation(step_with(mean_, scale_), row), 2.0, kRounding) << dof;
  }
}

TEST_F(LargestDeviation, CountsAPerformersOwnPostureWhereTheExamplesHardlyMove) {
  for (int dof = 0; dof < dofs_; ++dof) {
    const double own = representation::performer_deviation(dof);
    for (const double scale : {0.0, 0.2 * own}) {  // dropped degrees of freedom count too
      scale_[dof] = scale;
      Eigen::RowVectorXd row = mean_.transpose();
      row[dof] += 3.0 * own;
      EXPECT_NEAR(deviation(step_with(mean_, scale_), row), 3.0, kRounding) << dof;
    }
  }
}

TEST_F(LargestDeviation, IsForgottenOnReset) {
  ModelStep<double> step = step_with(mean_, scale_);
  Eigen::RowVectorXd row = mean_.transpose().array() + 1.0, output(dofs_ + 1);
  step.step(row, output);
  EXPECT_GT(step.largest_deviation(), 0.0);
  step.reset();
  EXPECT_EQ(step.largest_deviation(), 0.0);
}

}  // namespace
}  // namespace strut
