// SPDX-License-Identifier: MIT
// Levenberg-Marquardt in data driven local coordinates. Changing the states' coordinates by I + T moves (A, B, C) by
// (T A - A T, T B, -C T) and the output not at all: steps are taken orthogonal to all such directions.
#include "sysid/decompositions.h"
#include "sysid/output_error.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include <strut/core/error.h>
#include <strut/sysid/refine.h>
#include <strut/sysid/stability.h>

namespace strut::sysid {
namespace {

using detail::OutputError;
using detail::ParameterLayout;

constexpr double kFirstDamping = 1e-3;   // of the gram's diagonal: the start is near, Gauss-Newton is trusted
constexpr double kLeastDamping = 1e-12;  // below, rounding decides
constexpr double kMostDamping = 1e12;    // no step is short enough: the start was a minimum

void check(const LtiSystem& system, const std::vector<Experiment>& experiments, const RefineOptions& options) {
  check_experiments(experiments);
  if (system.num_inputs() != experiments.front().input.cols() ||
      system.num_outputs() != experiments.front().output.cols()) {
    throw InvalidArgument("system", "as many inputs and outputs as the clips", "others");
  }
  if (options.max_iterations < 0) {
    throw InvalidArgument("max_iterations", "0 or more", std::to_string(options.max_iterations));
  }
  if (!(options.max_radius > 0.0 && options.max_radius < 1.0)) {
    throw InvalidArgument("max_radius", "above 0 and below 1", std::to_string(options.max_radius));
  }
  if (!(options.tolerance >= 0.0)) throw InvalidArgument("tolerance", "0 or more", std::to_string(options.tolerance));
}

/// The inverse of the outputs' root mean square after the lead-ins; 1 for an output that is zero.
Eigen::VectorXd output_weights(const std::vector<Experiment>& clips) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(clips.front().output.cols());
  double frames = 0.0;
  for (const Experiment& clip : clips) {
    squares += clip.output.bottomRows(clip.num_fitted()).colwise().squaredNorm().transpose();
    frames += clip.num_fitted();
  }
  return squares.unaryExpr([frames](double s) { return s > 0.0 && std::isfinite(s) ? std::sqrt(frames / s) : 1.0; });
}

/// The system in coordinates in which the states it passes through on these clips are uncorrelated and of size one, so
/// that no element of A, B and C is out of scale.
LtiSystem with_white_states(const LtiSystem& system, const std::vector<Experiment>& clips) {
  constexpr double kMoves = 1e-12;  // of the largest variance: a state that hardly moves is not blown up further
  const Eigen::Index n = system.num_states();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  double frames = 0.0;
  for (const Experiment& clip : clips) {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(n);
    for (Eigen::Index t = 0; t < clip.num_frames(); ++t) {
      state = (system.a() * state + system.b() * clip.input.row(t).transpose()).eval();
      covariance.noalias() += state * state.transpose();
    }
    frames += clip.num_frames();
  }
  covariance /= frames;
  if (n == 0 || !covariance.allFinite() || !(covariance.trace() > 0.0)) return system;
  const detail::SymmetricEigen eigen = detail::symmetric_eigen(covariance);
  const Eigen::VectorXd size = eigen.values.cwiseMax(kMoves * eigen.values.tail(1)[0]).cwiseSqrt();
  const Eigen::MatrixXd to = size.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
  const Eigen::MatrixXd from = eigen.vectors * size.asDiagonal();
  return {to * system.a() * from, to * system.b(), system.c() * from, system.d()};
}

/// An orthonormal basis of the directions that change the output (parameters x fewer).
Eigen::MatrixXd local_coordinates(const LtiSystem& system) {
  constexpr double kIndependent = 1e-10;
  const ParameterLayout at = detail::layout_of(system);
  const Eigen::Index n = at.n;
  if (n == 0) return Eigen::MatrixXd::Identity(at.count(), at.count());
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(at.count(), n * n);
  for (Eigen::Index k = 0; k < n * n; ++k) {
    Eigen::MatrixXd t = Eigen::MatrixXd::Zero(n, n);
    t(k % n, k / n) = 1.0;
    const LtiSystem moved(t * system.a() - system.a() * t, t * system.b(), -system.c() * t,
                          Eigen::MatrixXd::Zero(at.l, at.m));
    moves.col(k) = detail::parameters_of(moved);
  }
  return detail::orthogonal_complement(moves, kIndependent);
}

/// A system with its error.
struct Judged {
  LtiSystem system;
  std::vector<Eigen::VectorXd> initial_states;
  double error = 0.0;
};

Judged judge(LtiSystem system, const OutputError& objective) {
  std::vector<Eigen::VectorXd> states = objective.initial_states(system);
  const double error = objective.value(system, states);
  return {std::move(system), std::move(states), error};
}

LtiSystem within_radius(const LtiSystem& system, double max_radius) {
  return {clip_eigenvalues(system.a(), max_radius), system.b(), system.c(), system.d()};
}

/// The normal equations in local coordinates.
struct LocalModel {
  Eigen::MatrixXd basis, gram;
  Eigen::VectorXd right, damping;
};

LocalModel local_model(const Judged& at, const OutputError& objective) {
  constexpr double kLeastScale = 1e-9;  // of the largest: a direction the clips say nothing of is damped all the same
  const OutputError::Derivatives full = objective.derivatives(at.system, at.initial_states);
  LocalModel local{local_coordinates(at.system), {}, {}, {}};
  local.gram = local.basis.transpose() * full.gram * local.basis;
  local.right = local.basis.transpose() * full.right;
  const Eigen::VectorXd diagonal = local.gram.diagonal();
  local.damping = diagonal.cwiseMax(kLeastScale * std::max(diagonal.maxCoeff(), 1e-300));
  return local;
}

/// The step of this damping, and the fall of the error that the quadratic model promises of it.
struct Step {
  Eigen::VectorXd parameters;
  double promised = 0.0;
};

Step damped_step(const LocalModel& local, double damping) {
  Eigen::MatrixXd damped = local.gram;
  damped.diagonal() += damping * local.damping;
  const Eigen::VectorXd step = damped.ldlt().solve(local.right);
  if (!step.allFinite()) return {Eigen::VectorXd::Zero(local.basis.rows()), 0.0};
  return {local.basis * step, 2.0 * step.dot(local.right) - step.dot(local.gram * step)};
}

}  // namespace

Refined refine_system(const LtiSystem& system, const std::vector<Experiment>& experiments,
                      const RefineOptions& options) {
  check(system, experiments, options);
  const OutputError objective(experiments, output_weights(experiments), options.from_rest);
  double frames = 0.0;
  for (const Experiment& clip : experiments) frames += clip.num_fitted();
  const double power = frames * system.num_outputs();
  Judged best = judge(with_white_states(within_radius(system, options.max_radius), experiments), objective);
  Refined result{best.system, best.error / power, best.error / power, 0};
  const ParameterLayout layout = detail::layout_of(system);
  LocalModel local = local_model(best, objective);
  double damping = kFirstDamping;
  double growth = 2.0;
  while (result.iterations < options.max_iterations && damping < kMostDamping) {
    ++result.iterations;
    const Step step = damped_step(local, damping);
    if (!(step.promised > options.tolerance * best.error)) break;
    const Eigen::VectorXd moved = detail::parameters_of(best.system) + step.parameters;
    Judged tried = judge(within_radius(detail::system_of(layout, moved), options.max_radius), objective);
    const double gained = best.error - tried.error;
    if (!(gained > 0.0)) {
      damping *= growth;
      growth *= 2.0;
      continue;
    }
    const double trust = gained / step.promised;
    damping = std::max(kLeastDamping, damping * std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * trust - 1.0, 3)));
    growth = 2.0;
    const bool settled = gained < options.tolerance * best.error;
    best = std::move(tried);
    if (settled) break;
    local = local_model(best, objective);
  }
  result.system = best.system;
  result.error = best.error / power;
  return result;
}

}  // namespace strut::sysid
