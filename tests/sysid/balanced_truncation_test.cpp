// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/balanced_truncation.h>

namespace strut::sysid {
namespace {

constexpr double kRounding = 1e-12;  // of numbers of size one
constexpr double kExact = 1e-9;      // rounding, magnified by the inverse roots of small singular values
constexpr int kLong = 120;           // taps after which known_system has forgotten all but
constexpr double kForgotten = 1e-5;  // 0.9^120, times gains of some units

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

/// Taps at random that decay, as a smoothed estimate's do.
ImpulseResponse random_response(int taps, Eigen::Index outputs, Eigen::Index inputs, unsigned seed) {
  std::mt19937 random(seed);
  ImpulseResponse response;
  for (int k = 0; k < taps; ++k) response.emplace_back(std::pow(0.8, k) * test::white_noise(outputs, inputs, random));
  return response;
}

double energy(const ImpulseResponse& response) {
  double total = 0.0;
  for (const Eigen::MatrixXd& tap : response) total += tap.squaredNorm();
  return total;
}

/// The difference of the responses, over so many taps that nothing is left: of 12 taps cos(pi / 12)^800 < 1e-11.
ImpulseResponse difference(const ImpulseResponse& response, const LtiSystem& system) {
  ImpulseResponse result = impulse_response(system, 800);
  for (std::size_t k = 0; k < response.size(); ++k) result[k] -= response[k];
  return result;
}

/// The largest gain at 64 frequencies from 0 to half of the frame rate.
double largest_gain(const ImpulseResponse& response) {
  double largest = 0.0;
  for (int f = 0; f <= 64; ++f) {
    Eigen::MatrixXcd transfer = Eigen::MatrixXcd::Zero(response.front().rows(), response.front().cols());
    for (std::size_t k = 0; k < response.size(); ++k) {
      transfer += response[k] * std::polar(1.0, -std::numbers::pi * f / 64.0 * static_cast<double>(k));
    }
    largest = std::max(largest, transfer.jacobiSvd().singularValues()[0]);
  }
  return largest;
}

TEST(ImpulseResponse, IsTheMarkovParameters) {
  const LtiSystem truth = test::known_system();
  const ImpulseResponse response = impulse_response(truth, 3);
  ASSERT_EQ(response.size(), 3u);
  EXPECT_EQ(response[0], truth.d());
  EXPECT_EQ(response[1], truth.c() * truth.b());
  EXPECT_EQ(response[2], truth.c() * (truth.a() * truth.b()));
  EXPECT_EQ(message_of([&] { impulse_response(truth, 0); }), "taps: expected 1 or more, got 0");
}

TEST(BalancedTruncation, FindsASystemAgain) {
  const LtiSystem truth = test::known_system();
  const TruncatedSystem found =
      balanced_truncation(impulse_response(truth, kLong), {.tolerance = kForgotten * kForgotten});
  EXPECT_EQ(found.system.num_states(), 4);
  EXPECT_LT(test::markov_difference(found.system, truth), kForgotten);
  EXPECT_LT(found.error, kForgotten);
  EXPECT_EQ(found.hankel_singular_values.size(), (kLong - 1) * 2) << "three outputs, two inputs";
}

TEST(BalancedTruncation, ErrsLessTheMoreStatesItKeeps) {
  const ImpulseResponse response = impulse_response(test::known_system(), 60);
  double last = 1.0;
  for (int order = 0; order <= 4; ++order) {
    const double error = balanced_truncation(response, {.max_order = order, .tolerance = 0.0}).error;
    EXPECT_LT(error, last) << order;
    last = error;
  }
  EXPECT_LT(last, 0.01);
}

TEST(BalancedTruncation, IsExactWithAllStates) {
  for (const Eigen::Vector2i& shape : {Eigen::Vector2i(2, 3), Eigen::Vector2i(3, 2), Eigen::Vector2i(1, 1)}) {
    const ImpulseResponse response = random_response(6, shape[0], shape[1], 1);
    const TruncatedSystem found = balanced_truncation(response, {.max_order = 100, .tolerance = 0.0});
    EXPECT_LT(std::sqrt(energy(difference(response, found.system))), kExact);
    EXPECT_LT(found.error, kExact);
    EXPECT_LT(found.bound, kExact);
  }
}

TEST(BalancedTruncation, BalancesTheGramians) {
  const TruncatedSystem found = balanced_truncation(random_response(6, 2, 2, 3), {.max_order = 100, .tolerance = 0.0});
  const LtiSystem& s = found.system;
  const Eigen::MatrixXd values = found.hankel_singular_values.head(s.num_states()).asDiagonal();
  EXPECT_LT((s.a() * values * s.a().transpose() + s.b() * s.b().transpose() - values).norm(), kExact);
  EXPECT_LT((s.a().transpose() * values * s.a() + s.c().transpose() * s.c() - values).norm(), kExact);
}

TEST(BalancedTruncation, OfADelayHasASingularValuePerFrame) {
  ImpulseResponse delay(4, Eigen::MatrixXd::Zero(1, 1));
  delay[3](0, 0) = 2.0;
  const TruncatedSystem found = balanced_truncation(delay, {.tolerance = 0.0});
  EXPECT_EQ(found.system.num_states(), 3);
  EXPECT_LT((found.hankel_singular_values - Eigen::Vector3d::Constant(2.0)).norm(), kRounding);
  EXPECT_LT(std::sqrt(energy(difference(delay, found.system))), kExact);
}

TEST(BalancedTruncation, SaysItsErrorAndBoundsTheGainOfWhatItLeavesOut) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const ImpulseResponse response = random_response(12, 2, 3, seed);
    double last_bound = std::numeric_limits<double>::infinity();
    for (int order = 0; order <= 20; order += 2) {
      const TruncatedSystem found = balanced_truncation(response, {.max_order = order, .tolerance = 0.0});
      const ImpulseResponse missed = difference(response, found.system);
      EXPECT_EQ(found.system.num_states(), order);
      EXPECT_NEAR(found.error, std::sqrt(energy(missed) / energy(response)), kExact);
      EXPECT_LE(largest_gain(missed), found.bound + kExact);
      EXPECT_GE(largest_gain(missed), 0.05 * found.bound) << "a bound of that order, not just any";
      EXPECT_LT(found.bound, last_bound);
      last_bound = found.bound;
    }
  }
}

TEST(BalancedTruncation, CountsWhatTheSystemAnswersAfterTheLastTap) {
  const ImpulseResponse step(10, Eigen::MatrixXd::Ones(1, 1));  // ends abruptly, which one state cannot
  const TruncatedSystem found = balanced_truncation(step, {.max_order = 1, .tolerance = 0.0});
  double within = 0.0;
  const ImpulseResponse missed = difference(step, found.system);
  for (std::size_t k = 0; k < step.size(); ++k) within += missed[k].squaredNorm();
  EXPECT_GT(found.error, 1.1 * std::sqrt(within / energy(step)));
}

RC_GTEST_PROP(BalancedTruncation, IsStableAtEveryOrder, ()) {
  const int taps = *rc::gen::inRange(1, 15);
  const auto outputs = *rc::gen::inRange<Eigen::Index>(1, 4);
  const auto inputs = *rc::gen::inRange<Eigen::Index>(1, 4);
  ImpulseResponse response = random_response(taps, outputs, inputs, *rc::gen::arbitrary<unsigned>());
  if (*rc::gen::arbitrary<bool>()) response.assign(response.size(), Eigen::MatrixXd::Ones(outputs, inputs));
  const int order = *rc::gen::inRange(0, 40);
  const LtiSystem system = balanced_truncation(response, {.max_order = order, .tolerance = 0.0}).system;
  RC_ASSERT(system.num_states() <= order);
  constexpr double kDefective = 1e-2;  // all of them zero: eigenvalues of a nilpotent matrix move by a root of rounding
  const double limit = std::cos(std::numbers::pi / taps);
  RC_ASSERT(system.spectral_radius() <= (system.num_states() == 0 ? 0.0 : std::max(limit + kRounding, kDefective)));
}

TEST(BalancedTruncation, TakesTheFewestStatesWithinTheTolerance) {
  const ImpulseResponse response = random_response(12, 2, 3, 7);
  for (const double tolerance : {0.3, 0.03, 0.003}) {
    const TruncatedSystem found = balanced_truncation(response, {.max_order = 22, .tolerance = tolerance});
    EXPECT_LE(found.error * found.error, tolerance);
    const int fewer = found.system.num_states() - 1;
    const TruncatedSystem rougher = balanced_truncation(response, {.max_order = fewer, .tolerance = 0.0});
    EXPECT_GT(rougher.error * rougher.error, tolerance);
  }
}

TEST(BalancedTruncation, OfAStaticOrVanishingResponseHasNoStates) {
  const Eigen::MatrixXd direct = Eigen::MatrixXd::Constant(2, 3, 5.0);
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(2, 3);
  for (const ImpulseResponse& response :
       {ImpulseResponse{direct}, ImpulseResponse{direct, nothing, nothing}, ImpulseResponse{nothing, nothing}}) {
    const TruncatedSystem found = balanced_truncation(response, {.tolerance = 0.0});
    EXPECT_EQ(found.system.num_states(), 0);
    EXPECT_EQ(found.system.d(), response.front());
    EXPECT_EQ(found.error, 0.0);
    EXPECT_EQ(found.bound, 0.0);
  }
}

TEST(BalancedTruncation, DoesNotCareForUnits) {
  for (const double unit : {1e-6, 1e6}) {
    ImpulseResponse response = random_response(10, 2, 2, 5);
    const TruncatedSystem plain = balanced_truncation(response);
    for (Eigen::MatrixXd& tap : response) tap *= unit;
    const TruncatedSystem scaled = balanced_truncation(response);
    EXPECT_EQ(scaled.system.num_states(), plain.system.num_states());
    EXPECT_NEAR(scaled.error, plain.error, kRounding);
    EXPECT_NEAR(scaled.bound / unit, plain.bound, kRounding * plain.hankel_singular_values.sum());
  }
}

TEST(BalancedTruncation, RefusesWhatCannotBeMeant) {
  const Eigen::MatrixXd tap = Eigen::MatrixXd::Ones(2, 1);
  const auto of = [](const ImpulseResponse& response, const TruncationOptions& options = {}) {
    return message_of([&] { balanced_truncation(response, options); });
  };
  EXPECT_EQ(of({}), "response: expected at least one tap, got none");
  EXPECT_EQ(of({Eigen::MatrixXd(0, 2)}), "response: expected at least one output and one input, got 0 x 2");
  EXPECT_EQ(of({tap, tap.transpose()}), "response: expected taps of 2 x 1, got 1 x 2");
  EXPECT_EQ(of({tap, std::nan("") * tap}), "response: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(of({tap}, {.max_order = -1}), "max_order: expected 0 or more, got -1");
  EXPECT_EQ(of({tap}, {.tolerance = -0.5}), "tolerance: expected 0 or more, got -0.500000");
  EXPECT_EQ(of({tap}), "(nothing thrown)");
}

}  // namespace
}  // namespace strut::sysid
