// SPDX-License-Identifier: MIT
// From a finite impulse response to a small state space: what a filter of a second's taps does, in a few states.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/sysid/lti_system.h>

namespace strut::sysid {

/// y[t] = sum over k of taps[k] u[t - k]; every tap is (outputs x inputs).
using ImpulseResponse = std::vector<Eigen::MatrixXd>;

struct TruncationOptions {
  int max_order = 8;         ///< most states kept, 0 or more
  double tolerance = 0.005;  ///< fewer are kept if what they leave out is at most this share of the response's energy
};

struct TruncatedSystem {
  LtiSystem system;
  Eigen::VectorXd hankel_singular_values;  ///< all, falling
  double error = 0.0;  ///< energy of the response's difference over energy of the response, square root of: 0 is exact
  double bound = 0.0;  ///< twice the sum of the singular values left out: bounds the gain of the difference at any
                       ///< frequency (Glover 1984)
};

/// The balanced realization of a finite impulse response, truncated (Moore 1981). The Hankel matrix of the response is
/// finite, so the truncation is exact and the system stable whatever the order.
/// Throws InvalidArgument if there is no tap, taps differ in shape or are not finite, or an option is out of range.
/// Cost (taps x outputs)^2 x taps x inputs, and (taps x outputs)^3.
TruncatedSystem balanced_truncation(const ImpulseResponse& response, const TruncationOptions& options = {});

/// The first `taps` taps of a system's impulse response: D, C B, C A B, ... Throws InvalidArgument if `taps` < 1.
ImpulseResponse impulse_response(const LtiSystem& system, int taps);

}  // namespace strut::sysid
