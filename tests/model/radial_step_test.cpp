// SPDX-License-Identifier: MIT
#include "support/allocations.h"
#include "support/small_model.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <strut/model/model_step.h>

namespace strut {
namespace {

using representation::kHeight;
using representation::kNumRootDofs;

constexpr double kRate = 30.0;
constexpr double kRounding = 1e-12;
constexpr double kForgotten = 1e-6;  // of a shock twenty seconds ago
constexpr int kSecond = 30;

StyleModelParts small_parts(int centres) {
  return test::radial_parts(test::turning_motion(kRate, 1.0), centres);
}

std::shared_ptr<const StyleModel> model_of(StyleModelParts parts) {
  return std::make_shared<const StyleModel>(std::move(parts));
}

/// Steps, one per row of `inputs`.
FrameMatrix run(ModelStep<double>& step, const FrameMatrix& inputs) {
  FrameMatrix outputs(inputs.rows(), inputs.cols() + 1);
  for (Eigen::Index t = 0; t < inputs.rows(); ++t) step.step(inputs.row(t), outputs.row(t));
  return outputs;
}

FrameMatrix run(const std::shared_ptr<const StyleModel>& model, const FrameMatrix& inputs) {
  ModelStep<double> step(model);
  return run(step, inputs);
}

FrameMatrix waves(Eigen::Index frames, Eigen::Index dofs, double size) {
  return FrameMatrix::NullaryExpr(frames, dofs,
                                  [&](auto t, auto d) { return size * std::sin(0.3 * double(t) + 1.7 * double(d)); });
}

/// A model of one place in the movement, whose style is the same throughout, and a second of input just like it.
struct Still {
  explicit Still(double share, double fast = 0.0) {
    StyleModelParts parts = small_parts(1);
    RadialMap& map = *parts.radial_map;
    map.fast = fast;
    map.share.setConstant(share);
    input = map.input.col(0).transpose().replicate(kSecond, 1);
    style = map.output.col(0).transpose();
    spread = map.spread;
    model = model_of(std::move(parts));
  }
  /// What of `detail` (a number a frame, in spreads), given to the joint at `joint`, is in the output; the rest of the
  /// output must not feel it.
  Eigen::VectorXd kept_of(const Eigen::VectorXd& detail) const {
    FrameMatrix with = input;
    for (Eigen::Index i = 0; i < 3; ++i) with.col(joint + i) += detail * spread[joint + i];
    FrameMatrix change = run(model, with).rowwise() - style;
    const Eigen::VectorXd kept = change.middleCols(joint, 3).rowwise().sum() / spread.segment(joint, 3).sum();
    change.middleCols(joint, 3).setZero();
    EXPECT_LT(change.cwiseAbs().maxCoeff(), kRounding);
    return kept;
  }

  static constexpr Eigen::Index joint = kNumRootDofs + 6;
  FrameMatrix input;
  Eigen::RowVectorXd style;
  Eigen::VectorXd spread;
  std::shared_ptr<const StyleModel> model;
};

TEST(RadialStep, GivesTheOutputStyleOfAnInputLikeTheInputStyle) {
  const Still still(0.5, 1.0);
  EXPECT_LT((run(still.model, still.input).rowwise() - still.style).norm(), kRounding);
}

TEST(RadialStep, RepeatsItselfAfterReset) {
  const auto model = model_of(small_parts(5));
  const FrameMatrix inputs = waves(60, model->num_dofs(), 0.4);
  ModelStep<double> step(model);
  const FrameMatrix first = run(step, inputs);
  step.reset();
  EXPECT_EQ(run(step, inputs), first);
  EXPECT_EQ(run(model, inputs), first);
  EXPECT_GT((first.row(59) - first.row(40)).norm(), 0.01);  // it does move
}

TEST(RadialStep, AllocatesNothing) {
  std::unique_ptr<Eigen::VectorXd> kept;
  ASSERT_GE(test::count_allocations([&] { kept = std::make_unique<Eigen::VectorXd>(100); }), 2);  // the counter counts
  const auto model = model_of(small_parts(5));
  ModelStep<double> step(model);
  const FrameMatrix inputs = waves(20, model->num_dofs(), 0.4);
  Eigen::RowVectorXd output(model->num_dofs() + 1);
  EXPECT_EQ(test::count_allocations([&] {
              for (Eigen::Index t = 0; t < inputs.rows(); ++t) step.step(inputs.row(t), output);
            }),
            0);
}

TEST(RadialStep, StaysFiniteWhateverComes) {
  const auto model = model_of(small_parts(5));
  for (const double size : {1e6, 1e100, 1e200}) {
    ModelStep<double> step(model);
    EXPECT_TRUE(run(step, waves(kSecond, model->num_dofs(), size)).allFinite()) << size;
    EXPECT_TRUE(run(step, waves(kSecond, model->num_dofs(), 0.4)).allFinite()) << size;
  }
}

TEST(RadialStep, ForgetsAShock) {
  const auto model = model_of(small_parts(5));
  const FrameMatrix usual = waves(20 * kSecond, model->num_dofs(), 0.4);
  ModelStep<double> step(model);
  run(step, waves(kSecond, model->num_dofs(), 1e6));
  EXPECT_LT((run(step, usual) - run(model, usual)).bottomRows(kSecond).norm(), kForgotten);
}

TEST(RadialStep, KeepsAnOrdinaryDetailByItsShare) {
  const Eigen::VectorXd kept = Still(0.3).kept_of(Eigen::VectorXd::Ones(kSecond));
  EXPECT_NEAR(kept[0], 0.3, 0.1);  // what is ordinary has no sharp end
  EXPECT_NEAR(kept[kSecond - 1], 0.3, 0.1);
}

TEST(RadialStep, KeepsADetailFarBeyondTheExamplesWhole) {
  constexpr double kSpreads = 20.0;
  const Eigen::VectorXd kept = Still(0.3).kept_of(Eigen::VectorXd::Constant(kSecond, kSpreads));
  EXPECT_NEAR(kept[kSecond - 1] / kSpreads, 1.0, 0.05);
}

TEST(RadialStep, KeepsOfFastDetailWhatItIsTold) {
  Eigen::VectorXd fast = 0.5 * Eigen::VectorXd::Ones(kSecond);
  for (Eigen::Index t = 1; t < fast.size(); t += 2) fast[t] *= -1.0;
  const double last = fast[kSecond - 1];
  EXPECT_NEAR(Still(0.0, 0.8).kept_of(fast)[kSecond - 1] / last, 0.8, 0.3);  // a one-pole filter parts them softly
  EXPECT_NEAR(Still(0.0, 0.0).kept_of(fast)[kSecond - 1] / last, 0.0, 0.05);
  const Eigen::VectorXd slow = Eigen::VectorXd::Constant(kSecond, 0.5);
  EXPECT_NEAR(Still(0.0, 0.8).kept_of(slow)[kSecond - 1] / 0.5, 0.0, 0.05);
}

TEST(RadialStep, SmoothsTheOutputStyleByTwoLowPassFilters) {
  StyleModelParts parts = small_parts(2);
  const int dofs = parts.input.num_dofs();
  parts.context = Eigen::MatrixXd::Zero(1, dofs);
  parts.context(0, kHeight) = 1.0;
  const Eigen::RowVector2d ends(-10.0, 10.0);
  RadialMap& map = *parts.radial_map;
  map.lags = {0};
  map.basis = {ends, 1.0};
  map.input = Eigen::MatrixXd::Zero(dofs, 2);
  map.input.row(kHeight) = ends;
  map.output = Eigen::MatrixXd::Zero(dofs + 1, 2);
  map.output(dofs, 1) = 1.0;
  map.smoothing = 4.0;
  FrameMatrix inputs = FrameMatrix::Zero(20, dofs);
  inputs.col(kHeight).setConstant(10.0);
  inputs.col(kHeight).head(5).setConstant(-10.0);
  const FrameMatrix outputs = run(model_of(parts), inputs);
  EXPECT_LT(outputs.col(dofs).head(5).norm(), kRounding);  // the first frame has lasted forever
  const double decay = std::exp(-1.0 / map.smoothing);
  for (int n = 0; n <= 15; ++n) {  // frames since the step
    EXPECT_NEAR(outputs(4 + n, dofs), 1.0 - std::pow(decay, n) * (1.0 + n * (1.0 - decay)), 1e-9) << n;
  }
}

TEST(RadialStep, TurnsADetailIntoTheOutputStylesAxes) {
  StyleModelParts parts = small_parts(1);
  std::vector<Eigen::Quaterniond> means = parts.output.mean_rotations();
  const auto joint = static_cast<std::size_t>(parts.output.joints()[0]);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, 2) / 3.0));
  means[joint] = means[joint] * turn.conjugate();
  parts.output = {parts.output.shared_skeleton(), means, parts.output.upright(), parts.output.travel_joint()};
  parts.radial_map->share.setOnes();
  const auto model = model_of(parts);
  FrameMatrix inputs = parts.radial_map->input.col(0).transpose();
  const FrameMatrix plain = run(model, inputs);
  const Eigen::Vector3d detail(0.05, -0.1, 0.02);
  inputs.block(0, kNumRootDofs, 1, 3) += detail.transpose();
  const Eigen::Vector3d change = (run(model, inputs) - plain).block(0, kNumRootDofs, 1, 3).transpose();
  EXPECT_LT((change - turn * detail).norm(), kRounding);
}

}  // namespace
}  // namespace strut
