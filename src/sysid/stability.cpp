// SPDX-License-Identifier: MIT
// Eigenvalue clipping on the real Schur form A = Q T Q': the eigenvalues of the quasi-triangular T are those of its 1 x
// 1 and 2 x 2 diagonal blocks, whatever stands above them, so scaling a block scales its eigenvalues and no others.
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/sysid/stability.h>

namespace strut::sysid {
namespace {

double spectral_radius_2x2(const Eigen::Matrix2d& block) {
  const double half_trace = 0.5 * block.trace();
  const double determinant = block.determinant();
  const double discriminant = half_trace * half_trace - determinant;
  return discriminant < 0.0 ? std::sqrt(determinant) : std::abs(half_trace) + std::sqrt(discriminant);
}

/// Scales the diagonal blocks of the quasi-triangular `t` that are too large; says whether there was one.
bool clip_blocks(Eigen::MatrixXd& t, double max_radius) {
  bool clipped = false;
  for (Eigen::Index k = 0; k < t.rows();) {
    const Eigen::Index size = k + 1 < t.rows() && t(k + 1, k) != 0.0 ? 2 : 1;
    const double radius = size == 1 ? std::abs(t(k, k)) : spectral_radius_2x2(t.block<2, 2>(k, k));
    if (radius > max_radius) {
      t.block(k, k, size, size) *= max_radius / radius;
      clipped = true;
    }
    k += size;
  }
  return clipped;
}

}  // namespace

Eigen::MatrixXd clip_eigenvalues(const Eigen::MatrixXd& a, double max_radius) {
  if (a.rows() != a.cols()) {
    throw InvalidArgument("a", "a square matrix", std::to_string(a.rows()) + " x " + std::to_string(a.cols()));
  }
  if (!a.allFinite()) throw InvalidArgument("a", "finite numbers", "NaN or infinity");
  if (!(max_radius > 0.0 && max_radius <= 1.0)) {
    throw InvalidArgument("max_radius", "above 0, at most 1", std::to_string(max_radius));
  }
  if (a.size() == 0) return a;
  const Eigen::RealSchur<Eigen::MatrixXd> schur(a);
  // The iteration failing is unheard of, but the norm bounds the radius too and needs no iteration.
  if (schur.info() != Eigen::Success) return a * std::min(1.0, max_radius / a.norm());
  Eigen::MatrixXd t = schur.matrixT();
  if (!clip_blocks(t, max_radius)) return a;
  return schur.matrixU() * t * schur.matrixU().transpose();
}

}  // namespace strut::sysid
