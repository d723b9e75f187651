// SPDX-License-Identifier: MIT
// Bilinear models on data that is exactly bilinear, on grids with holes, and on contents that no two styles share.
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <strut/blend/bilinear.h>
#include <strut/core/error.h>

namespace strut::blend {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kExact = 1e-6;  // of numbers of size 1: what the ridge of 1e-9 and the tolerance leave
constexpr BilinearOptions kTight{.ridge = 1e-9, .max_rounds = 3000, .tolerance = 1e-14};

MatrixXd random(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, cols, [&] { return normal(engine); });
}

constexpr int kStyles = 5, kContents = 6, kSize = 40;

/// Truth of rank 2 in content and, where `style_dims` is below the number of styles, of that rank in style.
std::vector<MatrixXd> truth(int style_dims) {
  const MatrixXd styles = random(style_dims, kStyles, 1), contents = random(2, kContents, 2);
  std::vector<MatrixXd> coefficients;
  for (int s = 0; s < kStyles; ++s) {
    MatrixXd a = MatrixXd::Zero(kSize, 2);
    for (int i = 0; i < style_dims; ++i) a += styles(i, s) * random(kSize, 2, 10 + static_cast<unsigned>(i));
    coefficients.emplace_back(a * contents);
  }
  return coefficients;
}

/// Every style with every content, but for the pairs in `missing`.
std::vector<BilinearObservation> grid(const std::vector<MatrixXd>& coefficients,
                                      const std::vector<std::pair<int, int>>& missing = {}) {
  std::vector<BilinearObservation> all;
  for (int s = 0; s < kStyles; ++s) {
    for (int c = 0; c < kContents; ++c) {
      if (std::find(missing.begin(), missing.end(), std::pair(s, c)) != missing.end()) continue;
      const VectorXd content = VectorXd::Unit(kContents, c);
      all.push_back({s, content, coefficients[static_cast<std::size_t>(s)] * content});
    }
  }
  return all;
}

double error(const BilinearModel& model, const std::vector<MatrixXd>& coefficients) {
  double most = 0.0;
  for (std::size_t s = 0; s < coefficients.size(); ++s) {
    most = std::max(most, (model.coefficients[s] - coefficients[s]).cwiseAbs().maxCoeff());
  }
  return most;
}

void expect_never_rises(const BilinearModel& model) {
  for (std::size_t k = 1; k < model.objective.size(); ++k) EXPECT_LT(model.objective[k], model.objective[k - 1]);
}

TEST(AsymmetricModel, IsExactInClosedFormOnACompleteGrid) {
  const auto coefficients = truth(kStyles);
  const BilinearModel model = fit_asymmetric(grid(coefficients), kStyles, 2, kTight);
  EXPECT_LT(error(model, coefficients), kExact);
  EXPECT_LT(model.objective.front(), 1e-5) << "the closed form needs no rounds; this is the ridge";
  EXPECT_TRUE(model.converged);
  ASSERT_EQ(model.contents.rows(), 2);
  // Every style is a matrix times the contents: projected on them it stays.
  const MatrixXd projection = model.contents.completeOrthogonalDecomposition().pseudoInverse() * model.contents;
  for (const MatrixXd& c : model.coefficients) EXPECT_LT((c * projection - c).cwiseAbs().maxCoeff(), kExact);
}

TEST(AsymmetricModel, FillsMissingCells) {
  const auto coefficients = truth(kStyles);
  const BilinearModel model =
      fit_asymmetric(grid(coefficients, {{0, 0}, {1, 3}, {2, 5}, {3, 1}, {4, 2}}), kStyles, 2, kTight);
  EXPECT_LT(error(model, coefficients), 1e-3);
  expect_never_rises(model);
}

TEST(AsymmetricModel, NeedsNoContentThatTwoStylesShare) {
  // A parabola's worth of content, seen at different places by every style.
  std::vector<BilinearObservation> all;
  std::vector<MatrixXd> coefficients;
  for (int s = 0; s < kStyles; ++s) {
    coefficients.emplace_back(random(kSize, 2, 30 + static_cast<unsigned>(s)) * random(2, 3, 50));
    for (int k = 0; k < 4; ++k) {
      const double x = -1.0 + 0.5 * k + 0.11 * s;
      const VectorXd content = Eigen::Vector3d(1.0, x, x * x);
      all.push_back({s, content, coefficients.back() * content});
    }
  }
  EXPECT_LT(error(fit_asymmetric(all, kStyles, 2, kTight), coefficients), kExact);
}

TEST(AsymmetricModel, GivesAStyleSeenOnceTheMeanStylesChange) {
  std::vector<BilinearObservation> all;
  for (int s = 0; s < 3; ++s) {
    for (int k = 0; k < (s == 2 ? 1 : 3); ++k) {
      const VectorXd content = Eigen::Vector2d(1.0, k - 1.0);
      all.push_back({s, content, VectorXd::Constant(2, 5.0 * s) + VectorXd::Constant(2, 2.0) * (k - 1.0)});
    }
  }
  const BilinearModel model = fit_asymmetric(all, 3, 2, {.ridge = 1e-3});
  EXPECT_NEAR(model.coefficients[2](0, 0) - model.coefficients[2](0, 1), 8.0, 0.1) << "its one example is met";
  EXPECT_GT(model.coefficients[2](0, 1), 0.5) << "and it changes as the others do";
}

TEST(SymmetricModel, IsExactOnSymmetricDataWithMissingCells) {
  const auto coefficients = truth(2);
  const BilinearModel whole = fit_symmetric(grid(coefficients), kStyles, 2, 2, kTight);
  EXPECT_LT(error(whole, coefficients), kExact);
  const BilinearModel holes =
      fit_symmetric(grid(coefficients, {{0, 0}, {0, 1}, {1, 3}, {2, 5}, {3, 1}, {4, 2}}), kStyles, 2, 2, kTight);
  EXPECT_LT(error(holes, coefficients), 1e-3);
  expect_never_rises(holes);
}

TEST(SymmetricModel, WithAsManyDimensionsAsStylesIsTheAsymmetric) {
  const auto coefficients = truth(kStyles);
  const BilinearModel model = fit_symmetric(grid(coefficients), kStyles, kStyles, 2, kTight);
  EXPECT_LT(error(model, coefficients), kExact);
}

TEST(SymmetricModel, DoesNotDivergeOnNoise) {
  std::vector<BilinearObservation> all = grid(truth(kStyles));
  for (std::size_t i = 0; i < all.size(); ++i) all[i].values += random(kSize, 1, 100 + static_cast<unsigned>(i));
  const BilinearModel model = fit_symmetric(all, kStyles, 2, 1);
  expect_never_rises(model);
  for (const MatrixXd& c : model.coefficients) EXPECT_TRUE(c.allFinite());
}

TEST(BilinearModel, RefusesWhatItCannotFit) {
  const auto all = grid(truth(kStyles));
  EXPECT_THROW(fit_asymmetric({}, 2, 1), InvalidArgument);
  EXPECT_THROW(fit_asymmetric(all, kStyles + 1, 2), InvalidArgument) << "a style that is never seen";
  EXPECT_THROW(fit_asymmetric(all, kStyles, kContents + 1), InvalidArgument);
  EXPECT_THROW(fit_symmetric(all, kStyles, 0, 1), InvalidArgument);
  EXPECT_THROW(fit_asymmetric(all, kStyles, 2, {.ridge = 0.0}), InvalidArgument);
  auto spoilt = all;
  spoilt[3].values[0] = std::nan("");
  EXPECT_THROW(fit_asymmetric(spoilt, kStyles, 2), InvalidArgument);
}

}  // namespace
}  // namespace strut::blend
