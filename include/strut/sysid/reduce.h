// SPDX-License-Identifier: MIT
// Fewer states for nearly the same response: balanced truncation of a stable system.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/sysid/lti_system.h>

namespace strut::sysid {

struct Reduced {
  LtiSystem system;                        ///< stable, at most as many states
  Eigen::VectorXd hankel_singular_values;  ///< of all states, falling
  double bound = 0.0;  ///< twice the sum of those left out: bounds the gain of the difference at any frequency
};

/// The system's balanced realization, truncated (Moore 1981; the bound is Glover's, 1984): its states are those that
/// inputs reach and outputs show most. Kept are at most `max_order` and no more than needed for the Hankel singular
/// values left out to be, in root of the sum of squares, at most `tolerance` of all.
/// Throws InvalidArgument if the system is not stable, `max_order` is negative or `tolerance` is not in [0, 1).
/// Cost a few dozen times states^3.
Reduced reduce_order(const LtiSystem& system, int max_order, double tolerance = 0.0);

/// The mean of the systems' responses, as one system: all their states side by side. Throws InvalidArgument if there
/// is none or they differ in inputs or outputs.
LtiSystem mean_system(const std::vector<LtiSystem>& systems);

}  // namespace strut::sysid
