// SPDX-License-Identifier: MIT
// What strut sysid found, as text for a person and as JSON for a program.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <strut/sysid/combine.h>
#include <strut/sysid/experiment.h>
#include <strut/sysid/identify.h>
#include <strut/sysid/noise_model.h>
#include <strut/sysid/residuals.h>

namespace strut::cli {

/// How well the system does on some clips.
struct SysidFits {
  Eigen::VectorXd simulated;                                             ///< from rest, per output [%]
  Eigen::VectorXd fitted;                                                ///< with every clip's initial state fitted [%]
  Eigen::VectorXd predicted;                                             ///< one frame ahead with the Kalman gain [%]
  double mean_simulated = 0.0, mean_fitted = 0.0, mean_predicted = 0.0;  ///< over outputs that vary [%]
};

/// All that is reported.
struct SysidFindings {
  std::string path;
  std::vector<std::string> inputs, outputs;    ///< names of columns
  std::vector<sysid::Experiment> train, test;  ///< about the means
  Eigen::RowVectorXd input_mean, output_mean;  ///< taken off, of the training rows
  sysid::Combined found;                       ///< of one estimate if no others were asked for
  sysid::NoiseModel noise;
  std::vector<Eigen::VectorXd> initial_states;  ///< of the training clips
  SysidFits train_fits, test_fits;
  sysid::ResidualTests prediction, simulation;  ///< of the training clips' residuals
};

/// Fits of a system on clips.
SysidFits fits_on(const std::vector<sysid::Experiment>& clips, const sysid::LtiSystem& system,
                  const Eigen::MatrixXd& gain);

/// The report for a person, on standard output.
void print_report(const SysidFindings& findings);

/// The same for a program, with the system.
nlohmann::ordered_json report_as_json(const SysidFindings& findings);

}  // namespace strut::cli
