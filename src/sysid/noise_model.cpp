// SPDX-License-Identifier: MIT
// Noise covariances and the Kalman gain, computed in balanced coordinates and taken back to the system's units:
// with outputs y = s z, R is s R_z s, S is S_z s and K is K_z / s.
#include "sysid/balance.h"
#include "sysid/block_rows.h"

#include <string>

#include <strut/core/error.h>
#include <strut/sysid/noise_model.h>
#include <strut/sysid/state_estimates.h>

namespace strut::sysid {
namespace {

constexpr double kNoise = 1e-9;  // of the outputs' size: less is the rounding of a system that explains them exactly

void check(const LtiSystem& system, const std::vector<Experiment>& experiments, int block_rows) {
  check_experiments(experiments);
  if (system.num_inputs() != experiments.front().input.cols() ||
      system.num_outputs() != experiments.front().output.cols()) {
    throw InvalidArgument("system", "as many inputs and outputs as the clips", "others");
  }
  if (block_rows < detail::kLeastBlockRows) {
    throw InvalidArgument("block_rows", "2 or more", std::to_string(block_rows));
  }
}

NoiseModel without_filter(NoiseCovariances covariances, const std::string& why, Diagnostics* diagnostics) {
  if (diagnostics != nullptr) diagnostics->note("noise model", why + ": no Kalman filter, predictions are simulations");
  Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(covariances.cross.rows(), covariances.cross.cols());
  Eigen::MatrixXd innovation = covariances.output;
  return {std::move(covariances), std::move(gain), std::move(innovation), false};
}

/// All error on the output: what can be said without estimates of the states.
NoiseCovariances output_error(const LtiSystem& system, const std::vector<Experiment>& clips) {
  const Eigen::Index n = system.num_states();
  const Eigen::Index l = system.num_outputs();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(l, l);
  double frames = 0.0;
  for (const Experiment& clip : clips) {
    const FrameMatrix error = (clip.output - simulate(system, clip.input)).bottomRows(clip.num_fitted());
    sum.noalias() += error.transpose() * error;
    frames += clip.num_fitted();
  }
  return {Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, l), sum / frames};
}

NoiseModel fit_balanced(const LtiSystem& system, const std::vector<Experiment>& clips, int block_rows,
                        Diagnostics* diagnostics) {
  const int usable = detail::usable_block_rows(clips, block_rows);
  if (usable == 0 || (usable - 1) * system.num_outputs() < system.num_states()) {
    return without_filter(output_error(system, clips), "the clips are too few or too short to estimate states",
                          diagnostics);
  }
  HankelFactor factor(system.num_inputs(), system.num_outputs(), usable);
  for (const Experiment& clip : clips) factor.add(clip);
  NoiseCovariances covariances = noise_covariances(system, estimate_states(factor, system.a(), system.c()));
  if (covariances.output.diagonal().maxCoeff() <= kNoise * kNoise) {
    return without_filter(std::move(covariances), "the system leaves no error", diagnostics);
  }
  const auto filter = stationary_kalman_filter(system.a(), system.c(), covariances);
  if (!filter) {
    return without_filter(std::move(covariances), "the Riccati equation has no stabilizing solution", diagnostics);
  }
  return {std::move(covariances), filter->gain, filter->innovation, true};
}

}  // namespace

NoiseModel fit_noise_model(const LtiSystem& system, const std::vector<Experiment>& experiments, int block_rows,
                           Diagnostics* diagnostics) {
  check(system, experiments, block_rows);
  const detail::Balance balance(experiments);
  if (balance.num_directions() == 0) {
    return without_filter(output_error(system, experiments), "no input ever differs from zero", diagnostics);
  }
  NoiseModel model = fit_balanced(balance.apply(system), balance.apply(experiments), block_rows, diagnostics);
  const auto scale = balance.output_scale().asDiagonal();
  model.covariances.cross = model.covariances.cross * scale;
  model.covariances.output = scale * model.covariances.output * scale;
  model.innovation = scale * model.innovation * scale;
  model.gain = model.gain * balance.output_scale().cwiseInverse().asDiagonal();
  return model;
}

FrameMatrix predict(const LtiSystem& system, const Eigen::MatrixXd& gain, const Experiment& experiment,
                    const Eigen::VectorXd& initial_state) {
  check(system, {experiment}, detail::kLeastBlockRows);
  const Eigen::Index n = system.num_states();
  if (gain.rows() != n || gain.cols() != system.num_outputs()) {
    throw InvalidArgument("gain", std::to_string(n) + " x " + std::to_string(system.num_outputs()),
                          std::to_string(gain.rows()) + " x " + std::to_string(gain.cols()));
  }
  if (initial_state.size() != 0 && initial_state.size() != n) {
    throw InvalidArgument("initial_state", std::to_string(n) + " elements", std::to_string(initial_state.size()));
  }
  Eigen::VectorXd state = initial_state.size() == 0 ? Eigen::VectorXd(Eigen::VectorXd::Zero(n)) : initial_state;
  Eigen::VectorXd scratch(n), y(system.num_outputs());
  FrameMatrix predicted(experiment.num_frames(), system.num_outputs());
  for (Eigen::Index t = 0; t < predicted.rows(); ++t) {
    system.step(state, experiment.input.row(t).transpose(), y, scratch);
    predicted.row(t) = y.transpose();
    if (t >= experiment.lead_in) state.noalias() += gain * (experiment.output.row(t).transpose() - y);
  }
  return predicted;
}

double predicted_fit(const LtiSystem& system, const Eigen::MatrixXd& gain, const std::vector<Experiment>& experiments) {
  FitSum sum(system.num_outputs());
  for (const Experiment& experiment : experiments) sum.add(experiment, predict(system, gain, experiment));
  return sum.fit();
}

}  // namespace strut::sysid
