// SPDX-License-Identifier: MIT
// The noise of an identified system: covariances from what it leaves of the estimated states, the Kalman gain, and
// prediction one frame ahead with it (innovation form).
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/core/diagnostics.h>
#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>
#include <strut/sysid/riccati.h>

namespace strut::sysid {

/// What the outputs do besides answering the inputs.
struct NoiseModel {
  NoiseCovariances covariances;  ///< in the system's units
  Eigen::MatrixXd gain;          ///< K (states x outputs); zero where `is_filter` is false
  Eigen::MatrixXd innovation;    ///< covariance of the prediction's error (outputs x outputs)
  bool is_filter = false;        ///< the Riccati equation had a solution
};

/// The noise model of `system` on these clips (Van Overschee and De Moor 1996, chapter 4): residuals of the states
/// estimated with `block_rows` frames of past and future (2 or more; fewer are used if clips are short), then the
/// stationary Kalman filter.
///
/// Never fails for want of a filter: where clips are too short, the system explains them without an error or the
/// Riccati equation has no solution, K is zero (prediction is then simulation) and a note in `diagnostics` says so.
/// Throws InvalidArgument as check_experiments does, or if the widths do not agree or `block_rows` is below 2.
/// Cost that of HankelFactor over all clips.
NoiseModel fit_noise_model(const LtiSystem& system, const std::vector<Experiment>& experiments, int block_rows = 10,
                           Diagnostics* diagnostics = nullptr);

/// The outputs predicted one frame ahead (frames x outputs):  y^[t] = C x[t] + D u[t],
/// x[t+1] = A x[t] + B u[t] + K (y[t] - y^[t]),  from `initial_state` (states; zero if empty) at the first row. In the
/// lead-in, where outputs are not known, it simulates. Throws InvalidArgument if widths do not agree.
FrameMatrix predict(const LtiSystem& system, const Eigen::MatrixXd& gain, const Experiment& experiment,
                    const Eigen::VectorXd& initial_state = {});

/// The fit (FitSum) of one-frame predictions on all clips together, each from rest [%]. Frame by frame it is above
/// simulated_fit where noise has colour: it knows the last output.
double predicted_fit(const LtiSystem& system, const Eigen::MatrixXd& gain, const std::vector<Experiment>& experiments);

}  // namespace strut::sysid
