// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/reduce.h>

namespace strut::sysid {
namespace {

constexpr double kSame = 1e-6;  // of responses of size one: the square root of rounding, as the gramians are squares

TEST(ReduceOrder, KeepsTheResponseInTheStatesItTakes) {
  const LtiSystem truth = test::known_system();
  const Reduced whole = reduce_order(truth, 10);
  EXPECT_EQ(whole.system.num_states(), 4);
  EXPECT_LT(test::markov_difference(whole.system, truth), kSame);
  const Reduced twice = reduce_order(mean_system({truth, truth, truth}), 10, 1e-6);
  EXPECT_EQ(twice.system.num_states(), 4);
  EXPECT_LT(test::markov_difference(twice.system, truth), kSame);
}

TEST(ReduceOrder, LeavesOutNoMoreThanItsBound) {
  const LtiSystem truth = test::known_system();
  double last = 1e300;
  for (int order = 0; order < 4; ++order) {
    const Reduced found = reduce_order(truth, order);
    EXPECT_EQ(found.system.num_states(), order);
    EXPECT_LT(found.system.spectral_radius(), 1.0);
    EXPECT_LE(test::markov_difference(found.system, truth), found.bound + kSame);
    EXPECT_LT(found.bound, last);
    last = found.bound;
  }
}

TEST(ReduceOrder, OfNearlyUnstableSystemsIsExactToo) {
  const LtiSystem slow(0.9999 * Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Ones(1, 1),
                       Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1));
  EXPECT_LT(test::markov_difference(reduce_order(slow, 1).system, slow), kSame);
}

TEST(ReduceOrder, TakesAStaticMapAndAStateThatDoesNothing) {
  const LtiSystem truth = test::known_system();
  const LtiSystem idle(truth.a(), Eigen::MatrixXd::Zero(4, 2), truth.c(), truth.d());
  const Reduced found = reduce_order(idle, 4);
  EXPECT_EQ(found.system.num_states(), 0);
  EXPECT_EQ(reduce_order(found.system, 3).system.d(), truth.d());
}

TEST(ReduceOrder, RefusesWhatCannotBeMeant) {
  const LtiSystem truth = test::known_system();
  EXPECT_THROW(reduce_order(truth, -1), InvalidArgument);
  EXPECT_THROW(reduce_order(truth, 2, 1.0), InvalidArgument);
  EXPECT_THROW(reduce_order({2.0 * truth.a(), truth.b(), truth.c(), truth.d()}, 2), InvalidArgument);
}

TEST(MeanSystem, AnswersWithTheMeanOfTheAnswers) {
  const LtiSystem truth = test::known_system();
  const LtiSystem map(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 2), Eigen::MatrixXd(3, 0), Eigen::MatrixXd::Ones(3, 2));
  std::mt19937 random(1);
  const FrameMatrix input = test::white_noise(30, 2, random);
  const FrameMatrix expected = 0.5 * (simulate(truth, input) + simulate(map, input));
  EXPECT_LT((simulate(mean_system({truth, map}), input) - expected).norm(), 1e-12);
  EXPECT_THROW(mean_system({}), InvalidArgument);
  const LtiSystem narrow(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 1), Eigen::MatrixXd(3, 0),
                         Eigen::MatrixXd::Ones(3, 1));
  EXPECT_THROW(mean_system({truth, narrow}), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
