// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {
namespace {

constexpr double kRounding = 1e-13;  // sums of some ten products of numbers of size one

Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index cols, std::initializer_list<double> values) {
  Eigen::MatrixXd result(rows, cols);
  auto value = values.begin();
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < cols; ++j) result(i, j) = *value++;
  }
  return result;
}

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols) {
  Eigen::MatrixXd result(rows, cols);
  for (double& element : result.reshaped()) element = static_cast<double>(*rc::gen::inRange(-1000, 1001)) / 1e3;
  return result;
}

LtiSystem random_system(int states) {
  return {0.3 * random_matrix(states, states), random_matrix(states, 2), random_matrix(3, states), random_matrix(3, 2)};
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

TEST(LtiSystem, AnswersAnImpulseByHand) {
  // x' = x/2 + 3u, y = 2x + 5u: the impulse's answer is 5, then 6, 3, 1.5.
  const LtiSystem system(matrix(1, 1, {0.5}), matrix(1, 1, {3}), matrix(1, 1, {2}), matrix(1, 1, {5}));
  const FrameMatrix output = simulate(system, matrix(4, 1, {1, 0, 0, 0}));
  EXPECT_EQ(output, FrameMatrix(matrix(4, 1, {5, 6, 3, 1.5})));
}

TEST(LtiSystem, StartsWhereItIsTold) {
  const LtiSystem system(matrix(1, 1, {0.5}), matrix(1, 1, {3}), matrix(1, 1, {2}), matrix(1, 1, {5}));
  const FrameMatrix output = simulate(system, FrameMatrix::Zero(3, 1), Eigen::VectorXd::Constant(1, 4.0));
  EXPECT_EQ(output, FrameMatrix(matrix(3, 1, {8, 4, 2})));
}

TEST(LtiSystem, WithoutStatesIsAStaticMap) {
  const Eigen::MatrixXd d = matrix(2, 1, {3, -1});
  const LtiSystem system(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 1), Eigen::MatrixXd(2, 0), d);
  EXPECT_EQ(system.num_states(), 0);
  EXPECT_EQ(system.spectral_radius(), 0.0);
  EXPECT_EQ(simulate(system, matrix(2, 1, {1, 2})), FrameMatrix(matrix(2, 2, {3, -1, 6, -2})));
}

TEST(LtiSystem, KnowsItsSpectralRadius) {
  const double c = 0.9 * std::cos(1.0);
  const double s = 0.9 * std::sin(1.0);
  const LtiSystem system(matrix(2, 2, {c, -s, s, c}), Eigen::MatrixXd::Zero(2, 1), Eigen::MatrixXd::Zero(1, 2),
                         Eigen::MatrixXd::Zero(1, 1));
  EXPECT_NEAR(system.spectral_radius(), 0.9, kRounding);
}

RC_GTEST_PROP(LtiSystem, IsLinear, ()) {
  const LtiSystem system = random_system(*rc::gen::inRange(0, 4));
  const FrameMatrix u = random_matrix(8, 2);
  const FrameMatrix v = random_matrix(8, 2);
  const FrameMatrix sum = simulate(system, FrameMatrix(2.0 * u - v));
  RC_ASSERT((sum - (2.0 * simulate(system, u) - simulate(system, v))).norm() < kRounding);
}

RC_GTEST_PROP(LtiSystem, IsTheSumOfItsMarkovParameters, ()) {
  const LtiSystem system = random_system(3);
  const FrameMatrix u = random_matrix(6, 2);
  const FrameMatrix output = simulate(system, u);
  for (Eigen::Index t = 0; t < 6; ++t) {
    Eigen::VectorXd y = system.d() * u.row(t).transpose();
    Eigen::MatrixXd power = Eigen::MatrixXd::Identity(3, 3);
    for (Eigen::Index k = t - 1; k >= 0; --k) {
      y += system.c() * power * system.b() * u.row(k).transpose();
      power = power * system.a();
    }
    RC_ASSERT((output.row(t).transpose() - y).norm() < kRounding);
  }
}

RC_GTEST_PROP(LtiSystem, StepsAsItSimulatesToTheBit, ()) {
  const LtiSystem system = random_system(2);
  const FrameMatrix u = random_matrix(5, 2);
  const FrameMatrix expected = simulate(system, u);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(2);
  Eigen::VectorXd scratch(2);
  Eigen::VectorXd y(3);
  for (Eigen::Index t = 0; t < 5; ++t) {
    system.step(state, u.row(t).transpose(), y, scratch);
    RC_ASSERT(y == expected.row(t).transpose());
  }
}

TEST(LtiSystem, RefusesShapesThatDoNotAgree) {
  const auto zeros = [](Eigen::Index rows, Eigen::Index cols) { return Eigen::MatrixXd::Zero(rows, cols).eval(); };
  const auto make = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& c,
                       const Eigen::MatrixXd& d) { return message_of([&] { LtiSystem(a, b, c, d); }); };
  EXPECT_EQ(make(zeros(2, 3), zeros(2, 1), zeros(1, 2), zeros(1, 1)), "a: expected 2 x 2, got 2 x 3");
  EXPECT_EQ(make(zeros(2, 2), zeros(3, 1), zeros(1, 2), zeros(1, 1)), "b: expected 2 x 1, got 3 x 1");
  EXPECT_EQ(make(zeros(2, 2), zeros(2, 1), zeros(2, 2), zeros(1, 1)), "c: expected 1 x 2, got 2 x 2");
  EXPECT_EQ(make(zeros(0, 0), zeros(0, 0), zeros(0, 0), zeros(0, 0)),
            "d: expected at least one output and one input, got 0 x 0");
}

TEST(LtiSystem, RefusesNumbersThatAreNone) {
  const Eigen::MatrixXd one = matrix(1, 1, {1});
  const Eigen::MatrixXd none = matrix(1, 1, {std::nan("")});
  EXPECT_EQ(message_of([&] { LtiSystem(one, none, one, one); }), "b: expected finite numbers, got NaN or infinity");
}

TEST(Simulate, RefusesInputAndStateOfAnotherWidth) {
  const Eigen::MatrixXd one = matrix(1, 1, {1});
  const LtiSystem system(one, one, one, one);
  EXPECT_EQ(message_of([&] { simulate(system, FrameMatrix::Zero(3, 2)); }), "input: expected 1 columns, got 2");
  EXPECT_EQ(message_of([&] { simulate(system, FrameMatrix::Zero(3, 1), Eigen::VectorXd::Zero(2)); }),
            "initial_state: expected 1 elements, got 2");
}

}  // namespace
}  // namespace strut::sysid
