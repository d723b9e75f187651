// SPDX-License-Identifier: MIT
// Regularized identification: every impulse response is estimated whole, under a prior that says it decays and is
// smooth, and then reduced to a few states. On short clips it predicts better than choosing an order.
#pragma once

#include <vector>

#include <strut/sysid/balanced_truncation.h>
#include <strut/sysid/experiment.h>
#include <strut/sysid/order.h>
#include <strut/sysid/stable_spline.h>

namespace strut::sysid {

/// How the prior's shape and scales are chosen.
enum class Selection {
  kLeftOut,             ///< by the error on groups of clips left out
  kMarginalLikelihood,  ///< by the probability of the data under the prior: for one record, whose noise is white
};

struct RegularizedOptions {
  Kernel kernel = Kernel::kTc;
  int taps = 30;  ///< length of the impulse responses [frames]
  Selection selection = Selection::kLeftOut;
  TruncationOptions truncation{.max_order = 12, .tolerance = 1e-3};  ///< to a state space
};

/// The prior that was chosen.
struct PriorParameters {
  KernelShape shape;
  std::vector<double> scales;  ///< variance of tap 0 over the noise's variance, per set of inputs
};

struct Regularized {
  LtiSystem system;
  double fit = 0.0;  ///< of clips left out, before truncation [%]
  PriorParameters prior;
  double truncation_error = 0.0;  ///< see TruncatedSystem::error
};

/// Identifies a stable system from clips: finite impulse responses by regularized least squares (Pillonetto, Dinuzzo,
/// Chen, De Nicolao and Ljung 2014, "Kernel methods in system identification"), then balanced truncation.
///
/// `input_sets` has an element per input: inputs of one set share a scale of their prior, so that some (a joint's own)
/// may be believed more than others (the rest of the body); sets count from 0. Clips are simulated from rest at the
/// start of their lead-in. `leave_out` says which clips judge the prior (see order.h); where it leaves nothing to
/// judge by, the marginal likelihood does.
/// Throws InvalidArgument as check_experiments does, if `leave_out` or `input_sets` differ in length, or for options
/// out of range. Cost per clip (frames x inputs x taps + (inputs x taps)^2), then (inputs x directions)^3 per trial,
/// some 30 of them, per fold.
Regularized identify_regularized(const std::vector<Experiment>& experiments, const LeaveOut& leave_out,
                                 const std::vector<int>& input_sets, const RegularizedOptions& options = {});

}  // namespace strut::sysid
