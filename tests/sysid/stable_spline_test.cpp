// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/stable_spline.h>

namespace strut::sysid {
namespace {

constexpr double kRounding = 1e-13;  // of numbers of size one, some tens of which are summed

KernelShape random_shape() {
  const auto kernel = *rc::gen::element(Kernel::kTc, Kernel::kDc, Kernel::kSs);
  return {kernel, 0.001 * *rc::gen::inRange(1, 1000), 0.01 * *rc::gen::inRange(-100, 101)};
}

double smallest_eigenvalue(const Eigen::MatrixXd& covariance) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).eigenvalues()[0];
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

TEST(StableSpline, HasTheValuesOfTheFormulas) {
  Eigen::Matrix3d tc, dc, ss;
  tc << 1.0, 0.64, 0.4096, 0.64, 0.64, 0.4096, 0.4096, 0.4096, 0.4096;
  EXPECT_LT((kernel_covariance({Kernel::kTc, 0.64}, 3) - tc).norm(), kRounding);
  dc << 1.0, 0.4, 0.16, 0.4, 0.64, 0.256, 0.16, 0.256, 0.4096;  // 0.8^(i + j) 0.5^|i - j|
  EXPECT_LT((kernel_covariance({Kernel::kDc, 0.64, 0.5}, 3) - dc).norm(), kRounding);
  // b = 1/2: 3/2 b^(i + 2j) - 1/2 b^(3j)
  ss << 1.0, 0.3125, 0.0859375, 0.3125, 0.125, 0.0390625, 0.0859375, 0.0390625, 0.015625;
  EXPECT_LT((kernel_covariance({Kernel::kSs, 0.125}, 3) - ss).norm(), kRounding);
}

TEST(StableSpline, OfDiagonalKindIsTheTunedOneAtTheRootOfTheDecay) {
  const double decay = 0.7;
  const Eigen::MatrixXd dc = kernel_covariance({Kernel::kDc, decay, std::sqrt(decay)}, 12);
  EXPECT_LT((dc - kernel_covariance({Kernel::kTc, decay}, 12)).norm(), kRounding);
}

RC_GTEST_PROP(StableSpline, IsACovarianceWhoseVarianceDecaysAsItSays, ()) {
  const KernelShape shape = random_shape();
  const int taps = *rc::gen::inRange(1, 25);
  const Eigen::MatrixXd covariance = kernel_covariance(shape, taps);
  RC_ASSERT(covariance.rows() == taps && covariance.cols() == taps);
  RC_ASSERT(covariance == covariance.transpose());
  RC_ASSERT(smallest_eigenvalue(covariance) > -kRounding * taps);
  for (int k = 0; k < taps; ++k) RC_ASSERT(std::abs(covariance(k, k) - std::pow(shape.decay, k)) < kRounding);
}

RC_GTEST_PROP(StableSpline, FactorReproducesItUpToTheDirectionsLeftOut, ()) {
  const KernelShape shape = random_shape();
  const int taps = *rc::gen::inRange(1, 25);
  const double least = *rc::gen::element(0.0, 1e-6, 1e-3, 0.3, 1.0);
  const Eigen::MatrixXd covariance = kernel_covariance(shape, taps);
  const Eigen::MatrixXd factor = kernel_factor(shape, taps, least);
  const Eigen::VectorXd variances = factor.colwise().squaredNorm();
  RC_ASSERT(factor.rows() == taps && factor.cols() >= 1 && factor.cols() <= taps);
  for (Eigen::Index k = 1; k < variances.size(); ++k) RC_ASSERT(variances[k] <= variances[k - 1] * (1.0 + kRounding));
  RC_ASSERT(variances.minCoeff() >= (least - kRounding) * variances[0]);
  const Eigen::MatrixXd missing = covariance - factor * factor.transpose();
  RC_ASSERT(missing.selfadjointView<Eigen::Lower>().operatorNorm() <= (least + kRounding * taps) * variances[0]);
}

TEST(StableSpline, FactorLeavesOutFewerDirectionsTheSmallerTheyMayBe) {
  const KernelShape shape{Kernel::kTc, 0.9};
  EXPECT_LT(kernel_factor(shape, 30).cols(), 30);
  EXPECT_LT(kernel_factor(shape, 30, 1e-2).cols(), kernel_factor(shape, 30, 1e-4).cols());
  EXPECT_EQ(kernel_factor(shape, 30, 0.0).cols(), 30);
}

TEST(StableSpline, SecondOrderIsSmoother) {
  const auto roughness = [](Kernel kernel) {  // variance of a tap's step over that of the tap
    const Eigen::MatrixXd k = kernel_covariance({kernel, 0.9}, 10);
    return (k(4, 4) - 2.0 * k(4, 5) + k(5, 5)) / k(4, 4);
  };
  EXPECT_LT(roughness(Kernel::kSs), 0.1 * roughness(Kernel::kTc));
}

TEST(StableSpline, RefusesShapesOutOfRange) {
  const auto of = [](const KernelShape& shape, int taps) {
    return message_of([&] { kernel_covariance(shape, taps); });
  };
  EXPECT_EQ(of({}, 0), "taps: expected 1 or more, got 0");
  EXPECT_EQ(of({Kernel::kTc, 0.0}, 3), "decay: expected above 0 and below 1, got 0.000000");
  EXPECT_EQ(of({Kernel::kTc, 1.0}, 3), "decay: expected above 0 and below 1, got 1.000000");
  EXPECT_EQ(of({Kernel::kTc, std::nan("")}, 3), "decay: expected above 0 and below 1, got nan");
  EXPECT_EQ(of({Kernel::kDc, 0.5, -1.5}, 3), "correlation: expected from -1 to 1, got -1.500000");
  EXPECT_EQ(message_of([] { kernel_factor({}, 0); }), "taps: expected 1 or more, got 0");
  EXPECT_EQ(message_of([] { kernel_factor({}, 3, -0.1); }), "least_variance: expected from 0 to 1, got -0.100000");
  EXPECT_EQ(of({}, 3), "(nothing thrown)");
}

}  // namespace
}  // namespace strut::sysid
