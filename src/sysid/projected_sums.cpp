// SPDX-License-Identifier: MIT
// With S = diag(deviations), coefficients g = S h, h of unit variance, and everything in units of the noise:
//
//   (S F'U'UF S + I) h = S F'U'y
//
//   U  lagged inputs, input by input (frames x (inputs x taps)); only U'U and U'y are known
//   F  the prior's factor, the same for every input (taps x directions)
#include "sysid/projected_sums.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace strut::sysid::detail {
namespace {

Eigen::LLT<Eigen::MatrixXd> decompose(const ProjectedSums& sums, const Eigen::VectorXd& s) {
  Eigen::MatrixXd precision = s.asDiagonal() * sums.uu * s.asDiagonal();
  precision.diagonal().array() += 1.0;
  return Eigen::LLT<Eigen::MatrixXd>(precision);
}

}  // namespace

ProjectedSums project(const LagSums& sums, const Eigen::MatrixXd& factor) {
  const Eigen::Index n = factor.rows();
  const Eigen::Index r = factor.cols();
  const Eigen::Index m = sums.uu.rows() / n;
  ProjectedSums projected{Eigen::MatrixXd::Zero(m * r, m * r), Eigen::MatrixXd(m * r, sums.uy.cols()), sums.yy,
                          sums.frames};
  for (Eigen::Index j = 0; j < m; ++j) {
    const Eigen::MatrixXd half = sums.uu.block(j * n, j * n, (m - j) * n, n) * factor;
    for (Eigen::Index i = j; i < m; ++i) {
      projected.uu.block(i * r, j * r, r, r).noalias() = factor.transpose() * half.middleRows((i - j) * n, n);
    }
    projected.uy.middleRows(j * r, r).noalias() = factor.transpose() * sums.uy.middleRows(j * n, n);
  }
  return projected;
}

ProjectedSums without(ProjectedSums sums, const ProjectedSums& some) {
  sums.uu -= some.uu;
  sums.uy -= some.uy;
  sums.yy -= some.yy;
  sums.frames -= some.frames;
  return sums;
}

Eigen::MatrixXd solve(const ProjectedSums& sums, const Eigen::VectorXd& deviations) {
  return deviations.asDiagonal() * decompose(sums, deviations).solve(deviations.asDiagonal() * sums.uy);
}

Eigen::VectorXd squared_errors(const ProjectedSums& sums, const Eigen::MatrixXd& coefficients) {
  const Eigen::MatrixXd modelled = sums.uu.selfadjointView<Eigen::Lower>() * coefficients;
  return sums.yy + coefficients.cwiseProduct(modelled - 2.0 * sums.uy).colwise().sum().transpose();
}

double negative_log_likelihood(const ProjectedSums& sums, const Eigen::VectorXd& deviations) {
  constexpr double kRounding = 1e-12;  // of the output's energy: a residual below it is none
  const auto llt = decompose(sums, deviations);
  const Eigen::MatrixXd explained = llt.matrixL().solve(deviations.asDiagonal() * sums.uy);
  const double log_determinant = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
  double total = 0.0;
  for (Eigen::Index o = 0; o < sums.yy.size(); ++o) {
    if (!(sums.yy[o] > 0.0)) continue;
    const double residual = std::max(sums.yy[o] - explained.col(o).squaredNorm(), kRounding * sums.yy[o]);
    total += sums.frames * std::log(residual / sums.frames) + log_determinant;
  }
  return total;
}

}  // namespace strut::sysid::detail
