// SPDX-License-Identifier: MIT
// Making a system matrix stable: what the model remembers must fade.
#pragma once

#include <Eigen/Core>

namespace strut::sysid {

/// A with every eigenvalue of modulus above `max_radius` drawn straight towards zero onto that modulus; the others, and
/// a matrix that has none such, are kept. Works on the real Schur form, so eigenvectors need not exist.
/// `a` (states x states), `max_radius` in (0, 1]. Throws InvalidArgument if `a` is not square or not finite, or
/// `max_radius` out of range. Cost states^3.
Eigen::MatrixXd clip_eigenvalues(const Eigen::MatrixXd& a, double max_radius);

}  // namespace strut::sysid
