// SPDX-License-Identifier: MIT
// From clips of paired signals to a stable system whose order was chosen on clips left out: the whole of identification
// in one call.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/core/diagnostics.h>
#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>
#include <strut/sysid/n4sid.h>

namespace strut::sysid {

/// How B and D are found once A and C are.
enum class InputMatrices {
  kSimulation,  ///< least squares on the simulated output (fit_input_matrices)
  kStates,      ///< the textbook's: least squares on estimated states (input_matrices_from_states); no ridge
};

/// How the number of states is chosen.
enum class OrderRule {
  kLeftOut,  ///< the smallest order whose left-out fit is within `order_tolerance` of the best
  kGap,      ///< where the singular values of the subspace step fall most (largest_gap), the paper's way
  kFixed,    ///< `max_order` itself, or as many as the data carry
};

/// From which states the clips that judge are simulated.
enum class Starts {
  kLeadIn,  ///< from rest at the start of their lead-in, as a streamed model runs
  kEvery,   ///< three times, the mean counts: so; from rest at their first frame; from the state that fits them best.
            ///< For a system that may be started anywhere: slow ones are otherwise judged by their start alone
};

struct IdentifyOptions {
  int max_order = 6;    ///< largest number of states tried [states]
  int block_rows = 10;  ///< past and future of the subspace step [frames]; fewer are used if clips are short
  Weighting weighting = Weighting::kCva;
  double max_radius = 0.95;      ///< eigenvalues of A are clipped to this modulus, above 0 and below 1
  double ridge = 0.0;            ///< shrinks B and D, see fit_input_matrices; 0.003 keeps human motion smooth
  double order_tolerance = 0.5;  ///< the smallest order whose left-out fit is this near to the best is taken [% fit]
  int num_folds = 4;             ///< sets of groups left out in turn, 2 or more
  InputMatrices input_matrices = InputMatrices::kSimulation;
  OrderRule order_rule = OrderRule::kLeftOut;
  Starts starts = Starts::kLeadIn;
  int refine_iterations = 0;  ///< steps of refine_system (from rest) tried on every order, 0 for none; kept where the
                              ///< left-out fit is better with it [steps]
};

struct Identified {
  LtiSystem system;
  double fit = 0.0;                  ///< of clips left out, at the chosen order [%]
  std::vector<double> left_out_fit;  ///< the same per order, from 0 to the largest that could be tried [%]
  Eigen::VectorXd singular_values;   ///< of the subspace step on all clips; empty if it could not be made
  std::vector<double> refined_fit;   ///< left_out_fit with refinement; empty if that was not asked for [%]
  bool is_refined = false;           ///< `system` is the refined one
};

/// Identifies a stable system from clips (Hsu et al. 2005, section 4.3, with B, D and the order from the simulated
/// output).
///
/// A and C come from the subspace step, unstable eigenvalues are clipped, then B and D are fitted on the simulated
/// output. Order 0, a static map, is a candidate. An order is judged by simulating from rest the clips that were left
/// out of everything (FitSum). Inputs that never move or are combinations of others are recognized; outputs are
/// balanced, so that units do not matter. There is no constant term: signals should have zero mean, or an input should
/// be constant.
///
/// `groups` has an element per clip: clips of one group are left out together (say, cut from the same recording). With
/// one group only, its clips are left out one by one; with one clip only, it is cut into pieces for that purpose.
/// Reports to `diagnostics`, if given, what it had to do without: block rows, the subspace step, moving inputs.
/// Throws InvalidArgument as check_experiments does, if `groups` differs in length, or for options out of range.
/// Cost: columns x width^2 (HankelFactor), then per fold and order frames x outputs x (states x inputs)^2, and with
/// refinement up to `refine_iterations` steps of refine_system.
Identified identify(const std::vector<Experiment>& experiments, const std::vector<int>& groups,
                    const IdentifyOptions& options = {}, Diagnostics* diagnostics = nullptr);

/// The best system of exactly `order` states on all clips (fewer if the data carry fewer), refined if `options` ask for
/// it: what `identify` does once the order is chosen. Same arguments and exceptions.
LtiSystem identify_order(const std::vector<Experiment>& experiments, int order, const IdentifyOptions& options = {},
                         Diagnostics* diagnostics = nullptr);

}  // namespace strut::sysid
