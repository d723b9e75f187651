// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <strut/core/error.h>
#include <strut/sysid/fit_radial_basis.h>

namespace strut::sysid {
namespace {

constexpr double kRounding = 1e-10;  // two ways to add up the same numbers of size one

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

Eigen::MatrixXd noise(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); });
}

/// Points at even distances on the unit circle, from `phase` on: (2 x count).
Eigen::MatrixXd circle(int count, double phase = 0.0) {
  Eigen::MatrixXd points(2, count);
  for (int t = 0; t < count; ++t) {
    const double angle = phase + 2.0 * std::numbers::pi * t / count;
    points.col(t) << std::cos(angle), std::sin(angle);
  }
  return points;
}

/// A smooth function of the place on the circle: (1 x points).
Eigen::MatrixXd wave(const Eigen::MatrixXd& points) {
  return (points.row(0).array() + 0.5 * (2.0 * points.row(0).array() * points.row(1).array())).matrix();
}

Eigen::VectorXd once(const Eigen::MatrixXd& points) {
  return Eigen::VectorXd::Ones(points.cols());
}

/// On points that count once each, from points at even distances.
RadialBasis basis_on(const Eigen::MatrixXd& points, int num_centres, double width_factor) {
  return fit_radial_basis(points, once(points), evenly_spaced(points.cols(), num_centres), width_factor);
}

RadialSums sums_of(const RadialBasis& basis, const Eigen::MatrixXd& points, const Eigen::MatrixXd& targets) {
  return radial_sums(basis, points, targets, once(points));
}

TEST(FitRadialBasis, PutsItsCentresIntoClusters) {
  const Eigen::Vector2d middles[] = {{-10, 0}, {10, 0}, {0, 17}};
  Eigen::MatrixXd points = noise(2, 60, 1);
  for (int t = 0; t < 60; ++t) points.col(t) += middles[t % 3];  // in turn: nothing is given by their order
  const RadialBasis basis = basis_on(points, 3, 1.0);
  for (int c = 0; c < 3; ++c) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (int t = c; t < 60; t += 3) mean += points.col(t) / 20.0;
    EXPECT_LT((basis.centres().colwise() - mean).colwise().norm().minCoeff(), kRounding) << c;
  }
}

TEST(FitRadialBasis, MakesItsWidthAMultipleOfTheDistanceToTheNearestCentre) {
  const Eigen::MatrixXd points = (Eigen::MatrixXd(1, 4) << -11.0, -9.0, 8.0, 12.0).finished();
  const RadialBasis basis = basis_on(points, 2, 3.0);
  EXPECT_LT((basis.centres() - Eigen::RowVector2d(-10, 10)).norm(), kRounding);
  EXPECT_NEAR(basis.width(), 3.0 * std::sqrt((1.0 + 1.0 + 4.0 + 4.0) / 4.0), kRounding);
}

TEST(FitRadialBasis, DependsOnItsArgumentsOnly) {
  const Eigen::MatrixXd points = noise(5, 200, 2);
  const RadialBasis a = basis_on(points, 20, 2.0), b = basis_on(points, 20, 2.0);
  EXPECT_EQ(a.centres(), b.centres());
  EXPECT_EQ(a.width(), b.width());
}

TEST(FitRadialBasis, MakesNoMoreCentresThanExamples) {
  EXPECT_EQ(basis_on(noise(3, 7, 3), 50, 1.0).num_centres(), 7);
  EXPECT_EQ(basis_on(noise(3, 1, 3), 50, 1.0).num_centres(), 1);
}

TEST(FitRadialBasis, OfOneCentreIsTheMean) {
  const Eigen::MatrixXd points = noise(3, 40, 4);
  EXPECT_LT((basis_on(points, 1, 1.0).centres() - points.rowwise().mean()).norm(), kRounding);
}

TEST(FitRadialBasis, OfEqualExamplesStillMaps) {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Constant(2, 10, 1e3);
  const RadialBasis basis = basis_on(points, 4, 2.0);
  EXPECT_GT(basis.width(), 0.0);
  const Eigen::MatrixXd phi = activations(basis, points);
  EXPECT_LT((phi.colwise().sum().array() - 1.0).abs().maxCoeff(), kRounding);
}

TEST(FitRadialBasis, RefusesArgumentsOutOfRange) {
  const Eigen::MatrixXd points = noise(2, 5, 5);
  const Eigen::VectorXd ones = once(points);
  const auto of = [](const Eigen::MatrixXd& examples, const Eigen::VectorXd& counts, std::vector<Eigen::Index> starts,
                     double width_factor) {
    return message_of([&] { fit_radial_basis(examples, counts, starts, width_factor); });
  };
  EXPECT_EQ(of(Eigen::MatrixXd(2, 0), Eigen::VectorXd(0), {0}, 1.0),
            "features: expected at least one example, got none");
  EXPECT_EQ(of(Eigen::MatrixXd::Constant(2, 5, INFINITY), ones, {0}, 1.0),
            "features: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(of(points, ones.head(4), {0}, 1.0), "counts: expected 5 numbers, got 4");
  EXPECT_EQ(of(points, 0.0 * ones, {0}, 1.0), "counts: expected numbers above 0, got one that is not");
  EXPECT_EQ(of(points, NAN * ones, {0}, 1.0), "counts: expected numbers above 0, got one that is not");
  EXPECT_EQ(of(points, ones, {}, 1.0), "starts: expected at least one, got none");
  EXPECT_EQ(of(points, ones, {0, 5}, 1.0), "starts: expected examples from 0 to 4, got 5");
  EXPECT_EQ(of(points, ones, {-1}, 1.0), "starts: expected examples from 0 to 4, got -1");
  EXPECT_EQ(of(points, ones, {0, 1}, 0.0), "width_factor: expected more than 0, got 0.000000");
  EXPECT_EQ(of(points, ones, {0, 1}, NAN), "width_factor: expected more than 0, got nan");
  EXPECT_EQ(message_of([] {
              fit_weights({Eigen::MatrixXd::Zero(2, 2), Eigen::MatrixXd::Zero(2, 1)}, 0.0);
            }),
            "ridge: expected more than 0, got 0.000000");
}

TEST(RadialActivations, AreTheFunctionsOfEveryExample) {
  const Eigen::MatrixXd points = noise(6, 50, 6);
  const RadialBasis basis = basis_on(points, 12, 1.0);
  const Eigen::MatrixXd all = activations(basis, points);
  Eigen::VectorXd one(12);
  for (Eigen::Index t = 0; t < points.cols(); ++t) {
    basis.activate(points.col(t), one);
    EXPECT_LT((all.col(t) - one).norm(), kRounding) << t;
  }
}

TEST(RadialWeights, FollowASmoothFunctionBetweenTheExamples) {
  const Eigen::MatrixXd points = circle(120);
  const RadialBasis basis = basis_on(points, 24, 2.0);
  const Eigen::MatrixXd weights = fit_weights(sums_of(basis, points, wave(points)), 1e-4);
  const Eigen::MatrixXd between = circle(120, std::numbers::pi / 120);
  constexpr double kShrunk = 0.01;  // of a wave of size one: what the ridge takes
  EXPECT_LT((weights * activations(basis, between) - wave(between)).cwiseAbs().maxCoeff(), kShrunk);
}

TEST(RadialWeights, SolveTheirNormalEquations) {
  const Eigen::MatrixXd points = noise(2, 30, 7), targets = noise(3, 30, 8);
  const RadialBasis basis = basis_on(points, 5, 1.0);
  const Eigen::MatrixXd phi = activations(basis, points), gram = phi * phi.transpose();
  const double ridge = 0.3 * gram.trace() / 5.0;
  const Eigen::MatrixXd weights = fit_weights(sums_of(basis, points, targets), 0.3);
  EXPECT_LT((weights * (gram + ridge * Eigen::MatrixXd::Identity(5, 5)) - targets * phi.transpose()).norm(), kRounding);
}

TEST(RadialWeights, ShrinkAsTheRidgeGrows) {
  const Eigen::MatrixXd points = circle(40);
  const RadialSums sums = sums_of(basis_on(points, 8, 2.0), points, wave(points));
  double last = INFINITY;
  for (const double ridge : {1e-6, 0.01, 0.1, 1.0, 100.0}) {
    const double size = fit_weights(sums, ridge).norm();
    EXPECT_LT(size, last) << ridge;
    last = size;
  }
  EXPECT_LT(last, 0.1);
}

TEST(RadialWeights, AreZeroWhereNoExampleIsNear) {
  const RadialBasis basis((Eigen::MatrixXd(1, 2) << 0.0, 1e3).finished(), 1.0);
  const Eigen::MatrixXd points = Eigen::MatrixXd::Zero(1, 10), targets = Eigen::MatrixXd::Constant(1, 10, 2.0);
  const Eigen::MatrixXd weights = fit_weights(sums_of(basis, points, targets), 1e-6);
  EXPECT_NEAR(weights(0, 0), 2.0, 1e-5);    // but for the ridge
  EXPECT_NEAR(weights(0, 1), 0.0, 1e-100);  // exp of -5e5 need not be zero to the bit
}

/// Every point as often as `counts` says.
Eigen::MatrixXd repeated(const Eigen::MatrixXd& points, const std::vector<int>& counts) {
  std::vector<Eigen::Index> places;
  for (std::size_t t = 0; t < counts.size(); ++t) places.insert(places.end(), counts[t], static_cast<Eigen::Index>(t));
  return points(Eigen::all, places);
}

TEST(FitRadialBasis, CountsAnExampleAsOftenAsItIsTold) {
  const Eigen::MatrixXd points = noise(2, 9, 9);
  const std::vector<int> counts = {1, 3, 2, 1, 1, 4, 1, 2, 1};
  const Eigen::VectorXd as_numbers = Eigen::Map<const Eigen::VectorXi>(counts.data(), 9).cast<double>();
  const Eigen::MatrixXd all = repeated(points, counts);
  const RadialBasis counted = fit_radial_basis(points, as_numbers, {0, 1, 8}, 2.0);
  const RadialBasis listed = fit_radial_basis(all, once(all), {0, 1, 15}, 2.0);
  EXPECT_LT((counted.centres() - listed.centres()).norm(), kRounding);
  EXPECT_NEAR(counted.width(), listed.width(), kRounding);
}

TEST(RadialSums, CountAnExampleAsOftenAsTheyAreTold) {
  const Eigen::MatrixXd points = noise(2, 4, 9), targets = noise(2, 4, 10);
  const std::vector<int> counts = {3, 1, 2, 1};
  const RadialBasis basis = basis_on(points, 4, 1.0);
  const RadialSums counted =
      radial_sums(basis, points, targets, Eigen::Map<const Eigen::VectorXi>(counts.data(), 4).cast<double>());
  const RadialSums listed = sums_of(basis, repeated(points, counts), repeated(targets, counts));
  EXPECT_LT((fit_weights(counted, 0.1) - fit_weights(listed, 0.1)).norm(), kRounding);
}

TEST(RadialSums, OfManyBlocksAreThoseOfAllExamples) {
  const Eigen::MatrixXd points = noise(3, 5000, 11), targets = noise(2, 5000, 12);
  const RadialBasis basis = basis_on(points, 7, 1.0);
  const Eigen::MatrixXd phi = activations(basis, points);
  const RadialSums sums = sums_of(basis, points, targets);
  EXPECT_LT((sums.cross - phi * targets.transpose()).norm(), kRounding);
  const Eigen::MatrixXd difference = (sums.gram - phi * phi.transpose()).triangularView<Eigen::Lower>();
  EXPECT_LT(difference.norm(), kRounding);
}

TEST(RadialPrediction, IsTheWeightsTimesTheActivations) {
  const Eigen::MatrixXd points = noise(3, 700, 13), weights = noise(2, 7, 14);
  const RadialBasis basis = basis_on(points, 7, 1.0);
  EXPECT_LT((predict(basis, weights, points) - weights * activations(basis, points)).norm(), kRounding);
}

TEST(FitRadialBasis, OfManyBlocksDoesNotDependOnTheNumberOfThreads) {
  const Eigen::MatrixXd points = noise(4, 5000, 15);
  const auto centres = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return basis_on(points, 30, 2.0).centres();
  };
  const Eigen::MatrixXd one = centres(1);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(centres(4), one) << i;
}

}  // namespace
}  // namespace strut::sysid
