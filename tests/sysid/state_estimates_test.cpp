// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/state_estimates.h>

namespace strut::sysid {
namespace {

constexpr double kExact = 1e-8;  // of numbers of size one, through two pseudo-inverses

HankelFactor factor_of(const std::vector<Experiment>& clips, int block_rows) {
  HankelFactor factor(static_cast<int>(clips[0].input.cols()), static_cast<int>(clips[0].output.cols()), block_rows);
  for (const Experiment& clip : clips) factor.add(clip);
  return factor;
}

TEST(StateEstimates, ObeyTheSystemThatMadeTheData) {
  const LtiSystem truth = test::known_system();
  const auto factor = factor_of(test::clips_of(truth, {.initial_state = 2.0}), 8);
  const StateEstimates found = estimate_states(factor, truth.a(), truth.c());
  const double size = found.state.norm();
  EXPECT_LT((found.state * truth.a().transpose() + found.input * truth.b().transpose() - found.next_state).norm(),
            kExact * size);
  EXPECT_LT((found.state * truth.c().transpose() + found.input * truth.d().transpose() - found.output).norm(),
            kExact * size);
  const NoiseCovariances noise = noise_covariances(truth, found);
  EXPECT_LT(noise.state.norm() + noise.cross.norm() + noise.output.norm(), kExact);
}

TEST(StateEstimates, GiveBAndDBackWithoutNoise) {
  const LtiSystem truth = test::known_system();
  const auto factor = factor_of(test::clips_of(truth, {.initial_state = 2.0}), 8);
  const LtiSystem found =
      input_matrices_from_states(truth.a(), truth.c(), estimate_states(factor, truth.a(), truth.c()));
  EXPECT_LT((found.b() - truth.b()).norm(), kExact);
  EXPECT_LT((found.d() - truth.d()).norm(), kExact);
}

TEST(StateEstimates, ShowTheOutputsNoise) {
  const LtiSystem truth = test::known_system();
  const double deviation = 0.3;
  const auto factor = factor_of(test::clips_of(truth, {.count = 60, .frames = 200, .noise = deviation}), 15);
  const NoiseCovariances noise = noise_covariances(truth, estimate_states(factor, truth.a(), truth.c()));
  // 10,000 frames tell a variance within a few hundredths; the states' own error, which adds to it, has faded.
  EXPECT_LT((noise.output / (deviation * deviation) - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 0.15);
}

TEST(StateEstimates, RefuseWhatDoesNotFit) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 3});
  EXPECT_THROW(estimate_states(factor_of(clips, 8), truth.a(), truth.c().topRows(2)), InvalidArgument);
  EXPECT_THROW(estimate_states(factor_of(clips, 8), truth.a().leftCols(3), truth.c()), InvalidArgument);
  EXPECT_THROW(estimate_states(factor_of(clips, 1), truth.a(), truth.c()), InvalidArgument);
  EXPECT_THROW(estimate_states(factor_of(clips, 2), truth.a(), truth.c()), InvalidArgument);  // 3 equations, 4 states
  EXPECT_THROW(noise_covariances(truth, estimate_states(factor_of(clips, 4), Eigen::MatrixXd::Zero(1, 1),
                                                        Eigen::MatrixXd::Zero(3, 1))),
               InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
