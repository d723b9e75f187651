// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/initial_state.h>

namespace strut::sysid {
namespace {

constexpr double kExact = 1e-9;  // of states of size one, without noise

/// A clip that starts in `state`.
Experiment clip_from(const LtiSystem& system, const Eigen::VectorXd& state, int frames) {
  std::mt19937 random(8);
  const FrameMatrix input = test::white_noise(frames, system.num_inputs(), random);
  return {input, simulate(system, input, state)};
}

TEST(InitialState, IsFoundFromTheOutput) {
  const LtiSystem truth = test::known_system();
  const Eigen::Vector4d state(1.0, -2.0, 0.5, 3.0);
  EXPECT_LT((estimate_initial_state(truth, clip_from(truth, state, 50)) - state).norm(), kExact);
  EXPECT_LT((estimate_initial_state(truth, clip_from(truth, state, 2)) - state).norm(), kExact) << "6 equations";
}

TEST(InitialState, IsThatAtTheLeadInsStart) {
  const LtiSystem truth = test::known_system();
  const Eigen::Vector4d state(1.0, -2.0, 0.5, 3.0);
  Experiment clip = clip_from(truth, state, 50);
  clip.lead_in = 5;
  clip.output.topRows(5).setConstant(1e3);  // must not be looked at
  EXPECT_LT((estimate_initial_state(truth, clip) - state).norm(), kExact);
}

TEST(InitialState, IsTheSmallestWhereTheOutputDoesNotTell) {
  const LtiSystem hidden(0.5 * Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Ones(2, 1),
                         Eigen::RowVector2d(1.0, 0.0), Eigen::MatrixXd::Zero(1, 1));
  const Eigen::VectorXd found = estimate_initial_state(hidden, clip_from(hidden, Eigen::Vector2d(2.0, 7.0), 20));
  EXPECT_NEAR(found[0], 2.0, kExact);
  EXPECT_NEAR(found[1], 0.0, kExact);
}

TEST(InitialState, StaysFiniteOnLongRecords) {
  const LtiSystem truth = test::known_system();
  EXPECT_LT((estimate_initial_state(truth, clip_from(truth, Eigen::Vector4d::Ones(), 20000)) - Eigen::Vector4d::Ones())
                .norm(),
            kExact);
  const LtiSystem map(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 2), Eigen::MatrixXd(3, 0), truth.d());
  EXPECT_EQ(estimate_initial_state(map, clip_from(truth, Eigen::Vector4d::Ones(), 9)).size(), 0);
}

TEST(InitialState, RefusesWhatDoesNotFit) {
  const LtiSystem truth = test::known_system();
  Experiment clip = clip_from(truth, Eigen::Vector4d::Ones(), 9);
  EXPECT_THROW(estimate_initial_state(truth, clip, Eigen::Vector3d(1.0, 0.0, 1.0)), InvalidArgument);
  clip.output = clip.output.leftCols(2).eval();
  EXPECT_THROW(estimate_initial_state(truth, clip), InvalidArgument);
}

TEST(ForgetsInitialState, AfterATenthIsLeft) {
  EXPECT_FALSE(forgets_initial_state(0.9, 21));
  EXPECT_TRUE(forgets_initial_state(0.9, 22));
  EXPECT_FALSE(forgets_initial_state(0.5, 0));
}

}  // namespace
}  // namespace strut::sysid
