// SPDX-License-Identifier: MIT
// The doubling algorithm. With S taken into  F = A - S R^-1 C  and  Q - S R^-1 S', the equation is that of the triple
//   F_0 = F',  G_0 = C' R^-1 C,  H_0 = Q - S R^-1 S'
// and each step doubles how many steps of the Riccati recursion H stands for:
//   W = I + G H,  F <- F W^-1 F,  G <- G + F W^-1 G F',  H <- H + F' H W^-1 F;   H tends to P.
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <strut/core/error.h>
#include <strut/sysid/lti_system.h>
#include <strut/sysid/riccati.h>

namespace strut::sysid {
namespace {

void check_shape(const char* name, const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index cols) {
  if (matrix.rows() != rows || matrix.cols() != cols) {
    throw InvalidArgument(name, std::to_string(rows) + " x " + std::to_string(cols),
                          std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()));
  }
  if (!matrix.allFinite()) throw InvalidArgument(name, "finite numbers", "NaN or infinity");
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

/// The limit of the doubling recursion; nothing if it does not settle.
std::optional<Eigen::MatrixXd> doubled(Eigen::MatrixXd f, Eigen::MatrixXd g, Eigen::MatrixXd h) {
  constexpr int kMostSteps = 60;       // 2^60 steps of the recursion: a radius of 1 - 1e-16 has settled
  constexpr double kSettled = 1e-14;   // of H: the next step would square it
  constexpr double kDiverged = 1e150;  // squares must not overflow
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd w = Eigen::MatrixXd::Identity(f.rows(), f.rows()) + g * h;
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(w);
    const Eigen::MatrixXd w_f = lu.solve(f);
    const Eigen::MatrixXd w_g = lu.solve(g);
    const Eigen::MatrixXd grown = f.transpose() * h * w_f;
    g = symmetric(g + f * w_g * f.transpose());
    h = symmetric(h + grown);
    f = (f * w_f).eval();
    const double size = h.norm();
    if (!(size < kDiverged && f.norm() < kDiverged && g.norm() < kDiverged)) return {};
    if (grown.norm() <= kSettled * size) return h;
  }
  return {};
}

}  // namespace

std::optional<KalmanFilter> stationary_kalman_filter(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                                     const NoiseCovariances& noise) {
  const Eigen::Index n = a.rows();
  const Eigen::Index l = c.rows();
  check_shape("a", a, n, n);
  check_shape("c", c, l, n);
  check_shape("noise.state", noise.state, n, n);
  check_shape("noise.cross", noise.cross, n, l);
  check_shape("noise.output", noise.output, l, l);
  const Eigen::LLT<Eigen::MatrixXd> r(noise.output);
  if (r.info() != Eigen::Success) return {};
  if (n == 0) return KalmanFilter{Eigen::MatrixXd(0, l), Eigen::MatrixXd(0, 0), noise.output};
  const Eigen::MatrixXd r_c = r.solve(c);
  const Eigen::MatrixXd f = (a - noise.cross * r_c).transpose();
  const Eigen::MatrixXd h = noise.state - noise.cross * r.solve(noise.cross.transpose());
  const std::optional<Eigen::MatrixXd> p = doubled(f, c.transpose() * r_c, symmetric(h));
  if (!p) return {};
  const Eigen::MatrixXd innovation = symmetric(c * *p * c.transpose() + noise.output);
  const Eigen::LLT<Eigen::MatrixXd> factor(innovation);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::MatrixXd gain = factor.solve((a * *p * c.transpose() + noise.cross).transpose()).transpose();
  if (!gain.allFinite()) return {};
  const LtiSystem filter(a - gain * c, gain, c, Eigen::MatrixXd::Zero(l, l));
  if (!(filter.spectral_radius() < 1.0)) return {};
  return KalmanFilter{gain, *p, innovation};
}

}  // namespace strut::sysid
