// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/input_matrices.h>
#include <strut/sysid/refine.h>

namespace strut::sysid {
namespace {

constexpr double kRecovered = 1e-6;  // of Markov parameters of size one, without noise

/// Every matrix moved by about `amount`.
LtiSystem perturbed(const LtiSystem& system, double amount) {
  std::mt19937 random(6);
  const auto moved = [&](const Eigen::MatrixXd& matrix) -> Eigen::MatrixXd {
    return matrix + amount * test::white_noise(matrix.rows(), matrix.cols(), random);
  };
  return {moved(system.a()), moved(system.b()), moved(system.c()), moved(system.d())};
}

TEST(Refine, FindsTheSystemFromNearby) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 8, .initial_state = 2.0});
  const Refined found = refine_system(perturbed(truth, 0.05), clips);
  EXPECT_LT(test::markov_difference(found.system, truth), kRecovered);
  EXPECT_LT(found.error, 1e-10);
}

TEST(Refine, FromRestFitsClipsThatStartThere) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 8});
  EXPECT_LT(test::markov_difference(refine_system(perturbed(truth, 0.05), clips, {.from_rest = true}).system, truth),
            kRecovered);
}

TEST(Refine, LooksOnlyBehindTheLeadIn) {
  const LtiSystem truth = test::known_system();
  auto clips = test::clips_of(truth, {.count = 8, .lead_in = 60});
  for (Experiment& clip : clips) clip.output.topRows(clip.lead_in).setConstant(1e3);
  EXPECT_LT(test::markov_difference(refine_system(perturbed(truth, 0.05), clips).system, truth), kRecovered);
}

TEST(Refine, NeverMakesTheErrorLarger) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 6, .noise = 1.0});
  for (const double amount : {0.01, 0.1, 0.3, 1.0}) {
    const LtiSystem start = perturbed(truth, amount);
    double last = refine_system(start, clips, {.max_iterations = 0}).error;
    for (const int steps : {1, 3, 10}) {
      const Refined found = refine_system(start, clips, {.max_iterations = steps});
      EXPECT_LE(found.error, last);
      EXPECT_LE(found.iterations, steps);
      EXPECT_LE(found.system.spectral_radius(), 0.999 + 1e-9);
      last = found.error;
    }
  }
}

TEST(Refine, StaysWithinTheRadius) {
  const LtiSystem slow(0.98 * Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Ones(1, 1),
                       Eigen::MatrixXd::Zero(1, 1));
  const auto clips = test::clips_of(slow, {.count = 6, .frames = 100});
  const LtiSystem start(0.5 * Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Ones(1, 1),
                        Eigen::MatrixXd::Zero(1, 1));
  EXPECT_NEAR(refine_system(start, clips, {.max_radius = 0.9}).system.spectral_radius(), 0.9, 1e-9);
  EXPECT_NEAR(refine_system(start, clips).system.spectral_radius(), 0.98, 1e-6);
}

TEST(Refine, OfAStaticMapIsLeastSquares) {
  const auto clips = test::clips_of(test::known_system(), {.count = 4, .noise = 0.5});
  const LtiSystem expected = fit_input_matrices(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(3, 0), clips);
  const LtiSystem start(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 2), Eigen::MatrixXd(3, 0),
                        Eigen::MatrixXd::Zero(3, 2));
  EXPECT_LT((refine_system(start, clips, {.tolerance = 0.0}).system.d() - expected.d()).norm(), kRecovered);
}

TEST(Refine, StandsDegenerateStartsAndData) {
  const LtiSystem truth = test::known_system();
  auto clips = test::clips_of(truth, {.count = 3});
  const LtiSystem nothing(Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 2), Eigen::MatrixXd::Zero(3, 4),
                          Eigen::MatrixXd::Zero(3, 2));
  EXPECT_LE(refine_system(nothing, clips).error, 1.0 + 1e-9);
  const LtiSystem unstable(1.2 * truth.a(), truth.b(), truth.c(), truth.d());
  EXPECT_LE(refine_system(unstable, clips).system.spectral_radius(), 0.999 + 1e-9);
  for (Experiment& clip : clips) {
    clip.input.col(1) = 2.0 * clip.input.col(0);
    clip.output.col(2).setZero();
  }
  EXPECT_LT(refine_system(perturbed(truth, 0.1), clips).error, 1.0);
  for (Experiment& clip : clips) clip.input.setZero();
  EXPECT_TRUE(std::isfinite(refine_system(truth, clips).error));
  EXPECT_TRUE(std::isfinite(refine_system(truth, test::clips_of(truth, {.count = 1, .frames = 1})).error));
}

TEST(Refine, RefusesWhatCannotBeMeant) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 2});
  EXPECT_THROW(refine_system(truth, {}), InvalidArgument);
  EXPECT_THROW(refine_system(truth, clips, {.max_iterations = -1}), InvalidArgument);
  EXPECT_THROW(refine_system(truth, clips, {.max_radius = 1.0}), InvalidArgument);
  EXPECT_THROW(refine_system(truth, clips, {.tolerance = -1.0}), InvalidArgument);
  const LtiSystem other(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 1), Eigen::MatrixXd(1, 0),
                        Eigen::MatrixXd::Ones(1, 1));
  EXPECT_THROW(refine_system(other, clips), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
