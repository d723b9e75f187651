// SPDX-License-Identifier: MIT
// Least squares for B and D. From a state x0 at the first frame,
//   y[t] = C A^t x0 + sum_b C Psi_b[t] B_b + D u[t],   Psi_b[t+1] = Psi_b[t] A + I u_b[t],   Psi_b[0] = 0
// with B_b a column of B and u_b an input. Psi_b is a polynomial in A, which is why A may stand on its right: a row
// c' Psi_b of the regression then needs only itself, states^2 a frame. The normal equations are summed clip by clip.
// Unknowns in order: B column by column, then D row by row.
#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <strut/core/error.h>
#include <strut/sysid/initial_state.h>
#include <strut/sysid/input_matrices.h>

namespace strut::sysid {
namespace {

struct NormalEquations {
  Eigen::MatrixXd gram;   // (unknowns x unknowns)
  Eigen::VectorXd right;  // (unknowns)
};

/// What a clip contributes: rows are one output over the fitted frames, then the next.
struct ClipRegression {
  Eigen::MatrixXd response;  ///< (outputs frames x states inputs): the part of B
  Eigen::MatrixXd initial;   ///< (outputs frames x states): the part of x0; empty when it is known to be zero
  Eigen::MatrixXd input;     ///< (frames x inputs): the part of D, the same for every output
  Eigen::VectorXd output;    ///< (outputs frames)
};

ClipRegression regression(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c, const Experiment& clip,
                          bool project_initial) {
  const Eigen::Index n = a.rows();
  const Eigen::Index m = clip.input.cols();
  const Eigen::Index l = c.rows();
  const Eigen::Index frames = clip.num_fitted();
  ClipRegression out{Eigen::MatrixXd(l * frames, n * m), Eigen::MatrixXd(project_initial ? l * frames : 0, n),
                     clip.input.bottomRows(frames), clip.output.bottomRows(frames).reshaped<Eigen::ColMajor>()};
  const Eigen::MatrixXd transposed = a.transpose();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, m * l);  // (c_o' Psi_b)' in column o + b l
  Eigen::MatrixXd decay = c.transpose();                   // (c_o' A^t)' in column o
  Eigen::MatrixXd next(n, m * l);
  for (Eigen::Index t = 0; t < clip.num_frames(); ++t) {
    const Eigen::Index row = t - clip.lead_in;
    for (Eigen::Index o = 0; o < l && row >= 0; ++o) {
      for (Eigen::Index b = 0; b < m; ++b) {
        out.response.row(o * frames + row).segment(b * n, n) = rows.col(o + b * l).transpose();
      }
      if (project_initial) out.initial.row(o * frames + row) = decay.col(o).transpose();
    }
    next.noalias() = transposed.lazyProduct(rows);
    for (Eigen::Index b = 0; b < m; ++b) next.middleCols(b * l, l) += clip.input(t, b) * c.transpose();
    rows.swap(next);
    if (project_initial && row >= 0) decay = transposed.lazyProduct(decay).eval();
  }
  return out;
}

/// Adds a clip's normal equations, its initial state projected out if it has one.
void accumulate(const ClipRegression& clip, Eigen::Index outputs, NormalEquations& equations) {
  const Eigen::Index b_size = clip.response.cols();
  const Eigen::Index m = clip.input.cols();
  const Eigen::Index frames = clip.input.rows();
  auto& gram = equations.gram;
  auto& right = equations.right;
  gram.topLeftCorner(b_size, b_size).selfadjointView<Eigen::Lower>().rankUpdate(clip.response.transpose());
  right.head(b_size).noalias() += clip.response.transpose() * clip.output;
  const Eigen::MatrixXd input_gram = clip.input.transpose() * clip.input;
  for (Eigen::Index o = 0; o < outputs; ++o) {
    const Eigen::Index at = b_size + o * m;
    gram.block(at, 0, m, b_size).noalias() += clip.input.transpose() * clip.response.middleRows(o * frames, frames);
    gram.block(at, at, m, m) += input_gram;
    right.segment(at, m).noalias() += clip.input.transpose() * clip.output.segment(o * frames, frames);
  }
  if (clip.initial.rows() == 0 || clip.initial.isZero(0.0)) return;
  constexpr double kIndependent = 1e-10;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(clip.initial.rows(), clip.initial.cols());
  qr.setThreshold(kIndependent);
  qr.compute(clip.initial);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(clip.initial.rows(), qr.rank());
  Eigen::MatrixXd seen(q.cols(), gram.rows());
  seen.leftCols(b_size).noalias() = q.transpose() * clip.response;
  for (Eigen::Index o = 0; o < outputs; ++o) {
    seen.middleCols(b_size + o * m, m).noalias() = q.middleRows(o * frames, frames).transpose() * clip.input;
  }
  gram.selfadjointView<Eigen::Lower>().rankUpdate(seen.transpose(), -1.0);
  right.noalias() -= seen.transpose() * (q.transpose() * clip.output);
}

Eigen::VectorXd solve(const NormalEquations& equations, double ridge) {
  constexpr double kLeastRidge = 1e-9;
  constexpr double kMoves = 1e-24;  // of the largest column, squared
  const Eigen::VectorXd squared = equations.gram.diagonal();
  const double least = kMoves * squared.maxCoeff();
  const Eigen::VectorXd scale =
      squared.unaryExpr([&](double s) { return s > least && s > 0.0 ? 1.0 / std::sqrt(s) : 0.0; });
  const Eigen::MatrixXd whole = equations.gram.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd gram = scale.asDiagonal() * whole * scale.asDiagonal();
  const Eigen::VectorXd right = scale.asDiagonal() * equations.right;
  const double added = std::max(ridge, kLeastRidge);
  const Eigen::LLT<Eigen::MatrixXd> factor(gram + added * Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));
  Eigen::VectorXd solution = factor.solve(right);
  if (ridge == 0.0) solution += factor.solve(right - gram * solution);
  return scale.asDiagonal() * solution;
}

}  // namespace

LtiSystem fit_input_matrices(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                             const std::vector<Experiment>& experiments, double ridge) {
  check_experiments(experiments);
  if (!(ridge >= 0.0 && std::isfinite(ridge))) throw InvalidArgument("ridge", "0 or more", std::to_string(ridge));
  const Eigen::Index n = a.rows();
  const Eigen::Index m = experiments.front().input.cols();
  const Eigen::Index l = experiments.front().output.cols();
  // Throws if A and C do not fit.
  const double radius = LtiSystem(a, Eigen::MatrixXd::Zero(n, m), c, Eigen::MatrixXd::Zero(l, m)).spectral_radius();
  NormalEquations equations{Eigen::MatrixXd::Zero(m * (n + l), m * (n + l)), Eigen::VectorXd::Zero(m * (n + l))};
  for (const Experiment& clip : experiments) {
    const bool project_initial = n > 0 && !forgets_initial_state(radius, clip.lead_in);
    accumulate(regression(a, c, clip, project_initial), l, equations);
  }
  const Eigen::VectorXd unknowns = solve(equations, ridge);
  return {a, unknowns.head(n * m).reshaped(n, m), c, unknowns.tail(l * m).reshaped<Eigen::RowMajor>(l, m)};
}

}  // namespace strut::sysid
