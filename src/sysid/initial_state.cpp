// SPDX-License-Identifier: MIT
// Least squares on the free response: y - simulated from rest = (C A^t) x0.
#include "sysid/decompositions.h"

#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/initial_state.h>

namespace strut::sysid {
namespace {

constexpr double kSeen = 1e-10;  // of the best seen direction of the state: less of it shows in the output as rounding
// Free response below this fraction of its start is left out: a decayed state says nothing, and long records are long.
constexpr double kDecayed = 1e-9;

void check(const LtiSystem& system, const Experiment& clip, const Eigen::VectorXd& weights) {
  check_experiments({clip});
  if (clip.output.cols() != system.num_outputs()) {
    throw InvalidArgument("experiment.output", std::to_string(system.num_outputs()) + " columns",
                          std::to_string(clip.output.cols()));
  }
  if (weights.size() != 0 && (weights.size() != system.num_outputs() || !(weights.minCoeff() > 0.0))) {
    throw InvalidArgument("weights", std::to_string(system.num_outputs()) + " positive numbers",
                          std::to_string(weights.size()) + " or one that is not");
  }
}

}  // namespace

bool forgets_initial_state(double spectral_radius, int lead_in) {
  constexpr double kForgotten = 0.1;
  return std::pow(spectral_radius, lead_in) <= kForgotten;
}

Eigen::VectorXd estimate_initial_state(const LtiSystem& system, const Experiment& experiment,
                                       const Eigen::VectorXd& weights) {
  check(system, experiment, weights);
  const Eigen::Index n = system.num_states();
  const Eigen::Index l = system.num_outputs();
  if (n == 0) return Eigen::VectorXd(0);
  const Eigen::VectorXd weight = weights.size() == 0 ? Eigen::VectorXd(Eigen::VectorXd::Ones(l)) : weights;
  const FrameMatrix rest = experiment.output - simulate(system, experiment.input);
  Eigen::MatrixXd free = weight.asDiagonal() * system.c();
  const double visible = kDecayed * free.norm();
  Eigen::MatrixXd responses(l * experiment.num_fitted(), n);
  Eigen::VectorXd wanted(responses.rows());
  Eigen::Index rows = 0;
  for (Eigen::Index t = 0; t < experiment.num_frames() && free.norm() >= visible; ++t) {
    if (t >= experiment.lead_in) {
      responses.middleRows(rows, l) = free;
      wanted.segment(rows, l) = weight.cwiseProduct(rest.row(t).transpose());
      rows += l;
    }
    free = (free * system.a()).eval();
  }
  if (rows == 0) return Eigen::VectorXd::Zero(n);
  const Eigen::VectorXd state = detail::least_squares(responses.topRows(rows), wanted.head(rows), kSeen);
  return state.allFinite() ? state : Eigen::VectorXd(Eigen::VectorXd::Zero(n));
}

}  // namespace strut::sysid
