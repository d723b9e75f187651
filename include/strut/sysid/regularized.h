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
  double fit = 0.0;  ///< of clips left out, before truncation, as experiment.h defines it, mean over the outputs that
                     ///< vary in them [%]; 0 if none does or no clip was left out
  PriorParameters prior;
  double truncation_error = 0.0;  ///< see TruncatedSystem::error
};

/// Identifies a stable system from clips: finite impulse responses by regularized least squares (Pillonetto, Dinuzzo,
/// Chen, De Nicolao and Ljung 2014, "Kernel methods in system identification, machine learning and function
/// estimation: A survey"), then balanced truncation.
///
/// `input_sets` has an element per input: inputs of one set share a scale of their prior, so that some (a joint's own)
/// may be believed more than others (the rest of the body); sets count from 0. Clips are simulated from rest at the
/// start of their lead-in; means are not taken off: a constant input allows for an offset. `leave_out` says which clips
/// judge the prior (see order.h); rounds without clips to learn from or to test do not count, and where none is left,
/// the marginal likelihood judges. Directions of the prior that hardly vary are left out (see kernel_factor: less than
/// a thousandth, of kSs 1e-5). The inputs of a set share a unit; which, and that of
/// each output, does not matter. Throws
/// InvalidArgument as check_experiments does, if `leave_out` or `input_sets` differ in length, a set is negative or not
/// below the number of inputs, or for options out of range. Cost per clip frames x inputs^2 x taps + (inputs x taps)^2;
/// then per shape tried, some 10, (inputs x taps)^2 x directions and per prior tried, some 20, (inputs x directions)^3,
/// both per round. Directions: of the prior, 5 to 20 for 30 taps.
Regularized identify_regularized(const std::vector<Experiment>& experiments, const LeaveOut& leave_out,
                                 const std::vector<int>& input_sets, const RegularizedOptions& options = {});

}  // namespace strut::sysid
