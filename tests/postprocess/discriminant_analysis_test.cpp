// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/postprocess/discriminant_analysis.h>

namespace strut::postprocess {
namespace {

constexpr double kRounding = 1e-9;     // of sums and roots of numbers of size one
constexpr double kScanStep = 1e-4;     // of the brute force search for a boundary
constexpr double kHardlyRidge = 1e-9;  // tells collinear features apart and changes nothing else

/// Two clouds about (0, 0) and `apart`, stretched along (1, 1).
struct Clouds {
  FrameMatrix examples;
  std::vector<bool> is_member;
};

Clouds clouds(int count, const Eigen::RowVector2d& apart, std::uint32_t seed = 5) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Clouds made{FrameMatrix(2 * count, 2), {}};
  for (int i = 0; i < 2 * count; ++i) {
    const double along = 3.0 * normal(random), across = 0.5 * normal(random);
    made.examples.row(i) << along - across, along + across;
    made.is_member.push_back(i >= count);
    if (i >= count) made.examples.row(i) += apart;
  }
  return made;
}

/// Separation of the projected classes: squared distance of their means in pooled variances.
double separation(const Clouds& made, const Eigen::Vector2d& w) {
  const Eigen::Index half = made.examples.rows() / 2;
  const Eigen::VectorXd x = made.examples * w;
  const auto variance = [](const Eigen::VectorXd& v) { return (v.array() - v.mean()).square().mean(); };
  const double distance = x.tail(half).mean() - x.head(half).mean();
  return distance * distance / (variance(x.tail(half)) + variance(x.head(half)));
}

double density(double x, const Gaussian& g) {
  const double z = (x - g.mean) / g.deviation;
  return std::exp(-0.5 * z * z) / g.deviation;
}

TEST(DiscriminantAnalysis, ByHand) {
  // Within-class scatter diag(1, 4) about (0, 0) and (2, 4): the projection is along (2 / 1, 4 / 4), 2 : 1.
  FrameMatrix examples(8, 2);
  examples << 1, 2, 1, -2, -1, 2, -1, -2, 3, 6, 3, 2, 1, 6, 1, 2;
  const std::vector<bool> is_member = {false, false, false, false, true, true, true, true};
  const Discriminant found = discriminant_analysis(examples, is_member, {.ridge = 0.0});
  EXPECT_NEAR(found.projection[0] / found.projection[1], 2.0, kRounding);
  EXPECT_NEAR(found.others.mean, 0.0, kRounding);
  EXPECT_NEAR(found.members.mean, 1.0, kRounding);
  // w = (2, 1) / 8: variances (4 * 1 + 1 * 4) / 64.
  EXPECT_NEAR(found.members.deviation, std::sqrt(8.0) / 8.0, kRounding);
  EXPECT_NEAR(found.boundary, 0.5, kRounding);
  EXPECT_TRUE(found.is_member(Eigen::Vector2d(2.0, 4.0)));
  EXPECT_FALSE(found.is_member(Eigen::Vector2d(0.0, 0.0)));
}

TEST(DiscriminantAnalysis, SeparatesAsWellAsTheBestOfAllDirections) {
  const Clouds made = clouds(300, {1.0, 0.2});
  const Discriminant found = discriminant_analysis(made.examples, made.is_member, {.ridge = 0.0});
  double best = 0.0;
  for (int degree = 0; degree < 1800; ++degree) {
    const double angle = 0.1 * degree * std::acos(-1.0) / 180.0;
    best = std::max(best, separation(made, {std::cos(angle), std::sin(angle)}));
  }
  EXPECT_GE(separation(made, found.projection), best * (1.0 - kRounding));
}

TEST(DiscriminantAnalysis, IsTheSameInOtherUnits) {
  const Clouds made = clouds(100, {1.0, 0.2});
  FrameMatrix scaled = made.examples;
  scaled.col(1) *= 1000.0;
  const Discriminant a = discriminant_analysis(made.examples, made.is_member, {.ridge = 0.1});
  const Discriminant b = discriminant_analysis(scaled, made.is_member, {.ridge = 0.1});
  EXPECT_NEAR(a.boundary, b.boundary, 1e-6);
  EXPECT_NEAR(a.projection[1], 1000.0 * b.projection[1], 1e-6);
}

TEST(DiscriminantAnalysis, OfCollinearFeaturesSharesTheWeight) {
  const Clouds made = clouds(100, {1.0, 0.2});
  FrameMatrix twice(made.examples.rows(), 4);
  twice << made.examples, made.examples.col(0), Eigen::VectorXd::Constant(made.examples.rows(), 7.0);
  const Discriminant once = discriminant_analysis(made.examples, made.is_member, {.ridge = kHardlyRidge});
  const Discriminant found = discriminant_analysis(twice, made.is_member, {.ridge = kHardlyRidge});
  EXPECT_NEAR(found.projection[0], found.projection[2], 1e-5);
  EXPECT_NEAR(found.projection[0] + found.projection[2], once.projection[0], 1e-5);
  EXPECT_EQ(found.projection[3], 0.0);  // a feature that never moves
  EXPECT_TRUE(discriminant_analysis(twice, made.is_member, {.ridge = 0.0}).projection.allFinite());
}

TEST(DiscriminantAnalysis, PriorsAreTheShares) {
  FrameMatrix examples(6, 1);
  examples << -1, 1, -1, 1, 3, 5;
  const std::vector<bool> is_member = {false, false, false, false, true, true};
  const Discriminant found = discriminant_analysis(examples, is_member);
  EXPECT_NEAR(found.boundary, decision_boundary(found.members, found.others, 1.0 / 3.0), kRounding);
  EXPECT_GT(found.boundary, discriminant_analysis(examples, is_member, {.prior = 0.5}).boundary);
}

TEST(DiscriminantAnalysis, OfClassesThatAreTheSameTakesTheLikelier) {
  FrameMatrix examples(6, 1);
  examples << -1, 1, -1, 1, -1, 1;
  const std::vector<bool> few = {true, true, false, false, false, false};
  EXPECT_FALSE(discriminant_analysis(examples, few).is_member(Eigen::VectorXd::Constant(1, 1.0)));
  const std::vector<bool> most = {true, true, true, true, false, false};
  EXPECT_TRUE(discriminant_analysis(examples, most).is_member(Eigen::VectorXd::Constant(1, 1.0)));
}

TEST(DiscriminantAnalysis, RefusesWhatItCannotUse) {
  const Clouds made = clouds(5, {1.0, 0.2});
  EXPECT_THROW(discriminant_analysis(made.examples, std::vector<bool>(3)), InvalidArgument);
  EXPECT_THROW(discriminant_analysis(made.examples, std::vector<bool>(10)), InvalidArgument);
  EXPECT_THROW(discriminant_analysis(made.examples, made.is_member, {.ridge = -1.0}), InvalidArgument);
  EXPECT_THROW(discriminant_analysis(made.examples, made.is_member, {.prior = 1.0}), InvalidArgument);
  FrameMatrix broken = made.examples;
  broken(0, 0) = std::nan("");
  EXPECT_THROW(discriminant_analysis(broken, made.is_member), InvalidArgument);
}

TEST(DecisionBoundary, IsWhereTheDensitiesMeet) {
  for (const double s1 : {0.1, 0.3, 0.5, 1.0}) {
    for (const double s0 : {0.1, 0.3, 0.5, 1.0}) {
      for (const double prior : {0.2, 0.5, 0.7}) {
        const Gaussian members{1.5, s1}, others{-0.5, s0};
        double x = others.mean;
        while (x < members.mean && prior * density(x, members) < (1.0 - prior) * density(x, others)) x += kScanStep;
        EXPECT_NEAR(decision_boundary(members, others, prior), x, 2.0 * kScanStep) << s1 << " " << s0 << " " << prior;
      }
    }
  }
}

TEST(DecisionBoundary, OfEqualDeviationsIsMovedByThePrior) {
  EXPECT_DOUBLE_EQ(decision_boundary({2.0, 0.5}, {0.0, 0.5}, 0.5), 1.0);
  // x = D / 2 + s^2 / D ln((1 - p) / p).
  EXPECT_NEAR(decision_boundary({2.0, 0.5}, {0.0, 0.5}, 0.2), 1.0 + 0.125 * std::log(4.0), kRounding);
}

TEST(DecisionBoundary, StaysBetweenTheMeans) {
  EXPECT_DOUBLE_EQ(decision_boundary({1.0, 5.0}, {0.0, 5.0}, 0.99), 0.0);
  EXPECT_DOUBLE_EQ(decision_boundary({1.0, 5.0}, {0.0, 5.0}, 0.01), 1.0);
  EXPECT_DOUBLE_EQ(decision_boundary({1.0, 0.0}, {0.0, 0.0}, 0.9), 0.5);
  EXPECT_NEAR(decision_boundary({1.0, 0.0}, {0.0, 0.1}, 0.5), 1.0, 1e-4);
  EXPECT_NEAR(decision_boundary({1.0, 0.1}, {0.0, 0.0}, 0.5), 0.0, 1e-4);
}

}  // namespace
}  // namespace strut::postprocess
