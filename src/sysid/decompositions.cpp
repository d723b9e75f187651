// SPDX-License-Identifier: MIT
#include "sysid/decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace strut::sysid::detail {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr(a.rows(), a.cols());
  qr.setThreshold(threshold);
  qr.compute(a);
  return qr.solve(b);
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a.rows(), a.cols());
  qr.setThreshold(threshold);
  qr.compute(a);
  const Eigen::MatrixXd q = qr.householderQ();
  return q.rightCols(a.rows() - qr.rank());
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace strut::sysid::detail
