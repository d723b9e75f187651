// SPDX-License-Identifier: MIT
// Balanced truncation by a square root: with gramians P = S S' and Q, and S' Q S = V diag(s)^2 V', the states
// diag(s)^-3/2 V' S' Q x have both gramians diag(s).
#include "sysid/decompositions.h"

#include <string>

#include <strut/core/error.h>
#include <strut/sysid/reduce.h>

namespace strut::sysid {
namespace {

/// The sum of A^k M A'^k over k = 0, 1, ..., by doubling.
Eigen::MatrixXd gramian(Eigen::MatrixXd a, const Eigen::MatrixXd& m) {
  constexpr int kMostSteps = 60;      // terms double every step
  constexpr double kSettled = 1e-16;  // of the sum
  Eigen::MatrixXd sum = m;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd grown = a * sum * a.transpose();
    sum += grown;
    if (grown.norm() <= kSettled * sum.norm()) break;
    a = (a * a).eval();
  }
  return 0.5 * (sum + sum.transpose());
}

/// S with S S' = M, for a symmetric M that is positive semidefinite but for rounding.
Eigen::MatrixXd square_root(const Eigen::MatrixXd& m) {
  const detail::SymmetricEigen eigen = detail::symmetric_eigen(m);
  return eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

int kept_states(const Eigen::VectorXd& values, int max_order, double tolerance) {
  constexpr double kRounding = 1e-7;  // of the largest: its square is lost beside the square of that
  const double allowed = tolerance * tolerance * values.squaredNorm();
  int kept = 0;
  while (kept < values.size() && kept < max_order && values[kept] > kRounding * values[0] &&
         (tolerance == 0.0 || values.tail(values.size() - kept).squaredNorm() > allowed)) {
    ++kept;
  }
  return kept;
}

}  // namespace

Reduced reduce_order(const LtiSystem& system, int max_order, double tolerance) {
  if (max_order < 0) throw InvalidArgument("max_order", "0 or more", std::to_string(max_order));
  if (!(tolerance >= 0.0 && tolerance < 1.0)) {
    throw InvalidArgument("tolerance", "0 or more and below 1", std::to_string(tolerance));
  }
  if (!(system.spectral_radius() < 1.0)) {
    throw InvalidArgument("system", "a stable system", "spectral radius " + std::to_string(system.spectral_radius()));
  }
  if (system.num_states() == 0) return {system, Eigen::VectorXd(0), 0.0};
  const Eigen::MatrixXd s = square_root(gramian(system.a(), system.b() * system.b().transpose()));
  const Eigen::MatrixXd q = gramian(system.a().transpose(), system.c().transpose() * system.c());
  const detail::SymmetricEigen eigen = detail::symmetric_eigen(s.transpose() * q * s);
  const Eigen::VectorXd values = eigen.values.reverse().cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd v = eigen.vectors.rowwise().reverse();
  const int kept = kept_states(values, max_order, tolerance);
  const Eigen::VectorXd scale = values.head(kept).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd to = scale.cwiseProduct(values.head(kept).cwiseInverse()).asDiagonal() *
                             v.leftCols(kept).transpose() * s.transpose() * q;
  const Eigen::MatrixXd from = s * v.leftCols(kept) * scale.asDiagonal();
  return {{to * system.a() * from, to * system.b(), system.c() * from, system.d()},
          values,
          2.0 * values.tail(values.size() - kept).sum()};
}

LtiSystem mean_system(const std::vector<LtiSystem>& systems) {
  if (systems.empty()) throw InvalidArgument("systems", "at least one", "none");
  const int m = systems.front().num_inputs();
  const int l = systems.front().num_outputs();
  int n = 0;
  for (const LtiSystem& system : systems) {
    if (system.num_inputs() != m || system.num_outputs() != l) {
      throw InvalidArgument("systems", "the same inputs and outputs", "others");
    }
    n += system.num_states();
  }
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b(n, m), c(l, n), d = Eigen::MatrixXd::Zero(l, m);
  const double share = 1.0 / static_cast<double>(systems.size());
  Eigen::Index at = 0;
  for (const LtiSystem& system : systems) {
    const Eigen::Index states = system.num_states();
    a.block(at, at, states, states) = system.a();
    b.middleRows(at, states) = system.b();
    c.middleCols(at, states) = share * system.c();
    d += share * system.d();
    at += states;
  }
  return {a, b, c, d};
}

}  // namespace strut::sysid
