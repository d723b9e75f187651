// SPDX-License-Identifier: MIT
// B and D by least squares on the simulated output, A and C given: what short, nearly periodic clips need instead of
// the textbook's regression on estimated states.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {

/// The system (A, B, C, D) whose output, simulated from rest at the start of each lead-in, fits the clips best in the
/// least squares sense over B and D.
///
/// A clip's initial state is projected out (fitted along with B and D, and forgotten) while more than a tenth of it is
/// left after the lead-in: spectral radius of A ^ lead_in > 0.1; so always without a lead-in. A longer lead-in has made
/// the state known, and projecting it out would only cost data.
///
/// Regularization: each column of the regression is scaled to length one and has a ridge. With `ridge` 0 it is 1e-9,
/// and one step of iterative refinement takes its bias away again where the data decide. A positive `ridge` shrinks B
/// and D towards zero where clips say little: without it, inputs that hardly move are amplified, noise and all. A
/// column of zeros (an input that never moves) gets zeros.
///
/// `a` (states x states), stable; `c` (outputs x states). Throws InvalidArgument as check_experiments does, and if A
/// and C do not fit each other or the outputs, or the ridge is negative. Cost frames x outputs x (states x inputs)^2.
LtiSystem fit_input_matrices(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                             const std::vector<Experiment>& experiments, double ridge = 0.0);

}  // namespace strut::sysid
