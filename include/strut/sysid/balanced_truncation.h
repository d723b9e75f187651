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
  Eigen::VectorXd hankel_singular_values;  ///< all, falling: (taps - 1) x the lesser of inputs and outputs
  double error = 0.0;  ///< root of the energy of the difference between the responses (what the system answers after
                       ///< the last tap included) over the energy of the given one: 0 is exact. Its square is at most
                       ///< `tolerance` unless `max_order` is reached
  double bound = 0.0;  ///< twice the sum of the singular values left out: bounds the gain of the difference at any
                       ///< frequency (Al-Saggaf and Franklin 1987; in continuous time Enns and Glover 1984)
};

/// Throws InvalidArgument if an option is out of range.
void check_truncation_options(const TruncationOptions& options);

/// The balanced realization of a finite impulse response, truncated (Kung 1978, Moore 1981): the fewest states within
/// the tolerance. The Hankel matrix of a finite response is finite, so nothing but the truncation is approximated, and
/// the system is stable whatever the order: poles are of modulus cos(pi / taps) at most.
/// Throws InvalidArgument if there is no tap, taps differ in shape or are not finite, or an option is out of range.
/// Cost (taps x outputs)^2 x taps x inputs, (taps x outputs)^3, and order^2 x taps x inputs per order tried.
TruncatedSystem balanced_truncation(const ImpulseResponse& response, const TruncationOptions& options = {});

/// The first `taps` taps of a system's impulse response: D, C B, C A B, ... Throws InvalidArgument if `taps` < 1.
ImpulseResponse impulse_response(const LtiSystem& system, int taps);

}  // namespace strut::sysid
