// SPDX-License-Identifier: MIT
// Kernels written so that one number, the decay of the variance from tap to tap, means the same for all of them:
//
//   TC  decay^j                                     DC  decay^((i + j) / 2) correlation^(j - i)
//   SS  3/2 b^(i + 2j) - 1/2 b^(3j), b^3 = decay        for taps i <= j
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/sysid/stable_spline.h>

namespace strut::sysid {
namespace {

void check(const KernelShape& shape, int taps) {
  if (taps < 1) throw InvalidArgument("taps", "1 or more", std::to_string(taps));
  if (!(shape.decay > 0.0 && shape.decay < 1.0)) {
    throw InvalidArgument("decay", "above 0 and below 1", std::to_string(shape.decay));
  }
  if (!(std::abs(shape.correlation) <= 1.0)) {
    throw InvalidArgument("correlation", "from -1 to 1", std::to_string(shape.correlation));
  }
}

/// The covariance of taps i <= j.
double covariance(const KernelShape& shape, int i, int j) {
  switch (shape.kernel) {
    case Kernel::kTc:
      break;
    case Kernel::kDc:
      return std::pow(shape.decay, 0.5 * (i + j)) * std::pow(shape.correlation, j - i);
    case Kernel::kSs: {
      const double b = std::cbrt(shape.decay);
      return 1.5 * std::pow(b, i + 2 * j) - 0.5 * std::pow(b, 3 * j);
    }
  }
  return std::pow(shape.decay, j);
}

}  // namespace

Eigen::MatrixXd kernel_covariance(const KernelShape& shape, int taps) {
  check(shape, taps);
  Eigen::MatrixXd result(taps, taps);
  for (int i = 0; i < taps; ++i) {
    for (int j = i; j < taps; ++j) result(i, j) = result(j, i) = covariance(shape, i, j);
  }
  return result;
}

Eigen::MatrixXd kernel_factor(const KernelShape& shape, int taps, double least_variance) {
  if (!(least_variance >= 0.0 && least_variance <= 1.0)) {
    throw InvalidArgument("least_variance", "from 0 to 1", std::to_string(least_variance));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(kernel_covariance(shape, taps));
  const Eigen::VectorXd& variances = eigen.eigenvalues();  // rising
  const auto kept = (variances.array() >= least_variance * variances[taps - 1]).count();
  return (eigen.eigenvectors().rightCols(kept) * variances.tail(kept).cwiseMax(0.0).cwiseSqrt().asDiagonal())
      .rowwise()
      .reverse();
}

}  // namespace strut::sysid
