// SPDX-License-Identifier: MIT
// The state a clip began in, from its output.
#pragma once

#include <Eigen/Core>

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {

/// The state at the clip's first row (of its lead-in, if it has one) from which the simulated output fits the clip best
/// in the least squares sense, each output weighted by `weights` (outputs; all 1 if empty). Of states that the output
/// cannot tell apart, the smallest.
///
/// Throws InvalidArgument as check_experiments does, or if the widths of system, clip and weights do not agree, or a
/// weight is not positive. Cost frames x outputs x states^2.
Eigen::VectorXd estimate_initial_state(const LtiSystem& system, const Experiment& experiment,
                                       const Eigen::VectorXd& weights = {});

/// Whether a lead-in this long leaves less than a tenth of what the state was at its start, so that starting from rest
/// there does no harm: radius ^ lead_in <= 0.1.
bool forgets_initial_state(double spectral_radius, int lead_in);

}  // namespace strut::sysid
