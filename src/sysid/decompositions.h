// SPDX-License-Identifier: MIT
// Private to identification: Eigen's decompositions that several of its sources use, compiled once.
#pragma once

#include <Eigen/Core>

namespace strut::sysid::detail {

/// The shortest X that makes |A X - B| least; directions of A below `threshold` of its largest count as none.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double threshold);

/// An orthonormal basis of what is orthogonal to the columns of A (rows of A x fewer); columns nearer than `threshold`
/// to a combination of others count as that.
Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a, double threshold);

/// Eigenvalues of a symmetric matrix, rising, and their eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

}  // namespace strut::sysid::detail
