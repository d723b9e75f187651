// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/stability.h>

namespace strut::sysid {
namespace {

constexpr double kRounding = 1e-12;          // a few roundings of numbers of size one
constexpr double kDefectiveRounding = 1e-4;  // a threefold eigenvalue moves by the cube root of a rounding

double spectral_radius(const Eigen::MatrixXd& a) {
  return a.eigenvalues().cwiseAbs().maxCoeff();
}

Eigen::MatrixXd rotation_by(double angle, double scale) {
  Eigen::MatrixXd a(2, 2);
  a << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return scale * a;
}

TEST(ClipEigenvalues, LeavesAStableMatrixAsItIs) {
  const Eigen::MatrixXd a = rotation_by(0.4, 0.9);
  EXPECT_EQ(clip_eigenvalues(a, 0.95), a);
  EXPECT_EQ(clip_eigenvalues(Eigen::MatrixXd(0, 0), 0.95).size(), 0);
}

TEST(ClipEigenvalues, KeepsTheFrequencyOfAPair) {
  const Eigen::MatrixXd clipped = clip_eigenvalues(rotation_by(0.4, 1.3), 0.95);
  EXPECT_NEAR((clipped - rotation_by(0.4, 0.95)).norm(), 0.0, kRounding);
}

TEST(ClipEigenvalues, MovesOnlyThoseThatAreTooLarge) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3, 3);
  a.diagonal() << 0.5, -1.2, 0.8;
  Eigen::MatrixXd basis(3, 3);
  basis << 1.0, 0.2, 0.0, -0.3, 1.0, 0.5, 0.1, 0.0, 1.0;
  Eigen::VectorXd moved = clip_eigenvalues(basis * a * basis.inverse(), 0.9).eigenvalues().real();
  std::sort(moved.begin(), moved.end());
  EXPECT_NEAR((moved - Eigen::Vector3d(-0.9, 0.5, 0.8)).norm(), 0.0, kRounding);
}

TEST(ClipEigenvalues, NeedsNoEigenvectors) {
  Eigen::MatrixXd jordan = 1.1 * Eigen::MatrixXd::Identity(3, 3);
  jordan(0, 1) = jordan(1, 2) = 1.0;
  EXPECT_LE(spectral_radius(clip_eigenvalues(jordan, 0.95)), 0.95 + kDefectiveRounding);
  EXPECT_GT(spectral_radius(jordan), 1.0);
}

TEST(ClipEigenvalues, StandsMatricesOfEverySize) {
  for (int n = 1; n < 30; ++n) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [](Eigen::Index row, Eigen::Index col) {
      return std::sin(static_cast<double>(7 * row * row + 3 * col + 1));
    });
    const Eigen::MatrixXd clipped = clip_eigenvalues(a, 0.9);
    ASSERT_EQ(clipped.rows(), n);
    EXPECT_LE(spectral_radius(clipped), 0.9 + 1e-9) << n;
  }
}

TEST(ClipEigenvalues, RefusesWhatIsNoSystemMatrix) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(clip_eigenvalues(Eigen::MatrixXd::Zero(2, 3), 0.9), InvalidArgument);
  EXPECT_THROW(clip_eigenvalues(Eigen::MatrixXd::Constant(2, 2, nan), 0.9), InvalidArgument);
  EXPECT_THROW(clip_eigenvalues(Eigen::MatrixXd::Zero(2, 2), 0.0), InvalidArgument);
  EXPECT_THROW(clip_eigenvalues(Eigen::MatrixXd::Zero(2, 2), 1.1), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
