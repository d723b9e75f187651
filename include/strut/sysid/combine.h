// SPDX-License-Identifier: MIT
// The mean of several estimates of one system, where clips left out say that it is better than any of them.
#pragma once

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/sysid/identify.h>
#include <strut/sysid/regularized.h>

namespace strut::sysid {

/// The estimates that are tried: identify(), identify_regularized(), a static map. Filtered ones see the clips through
/// prefilter(), with error_correlation().
enum class Estimate { kSubspace, kFilteredSubspace, kRegularized, kFilteredRegularized, kStatic };

struct CombineOptions {
  IdentifyOptions identification{.starts = Starts::kEvery, .refine_iterations = 20};
  RegularizedOptions regularization{
      .kernel = Kernel::kDc, .taps = 45, .truncation = {.max_order = 30, .tolerance = 1e-4}};
  int max_states = 24;      ///< of a mean of several estimates, after reduction [states]
  double reduction = 1e-3;  ///< tolerance of that reduction, see reduce_order
  double tolerance = 0.0;   ///< the fewest estimates whose left-out fit is this near to the best are taken [% fit]
};

struct Combined {
  LtiSystem system;
  double fit = 0.0;                 ///< of clips left out [%]
  std::vector<Estimate> estimates;  ///< that `system` is the mean of, 1 or more
  std::vector<double> fit_alone;    ///< left-out fit of each Estimate by itself, in the order of that type; of
                                    ///< kSubspace only where no other was tried [%]
  Identified subspace;              ///< how kSubspace was identified
  double error_correlation = 0.0;   ///< what the filtered estimates were filtered with
};

/// Identifies a system five ways, by identify() and identify_regularized(), each on the clips as they are and filtered,
/// and as a static map, and takes the mean of those (every set of them is tried) that predicts clips left out best,
/// reduced to few states (reduce_order). Errors of estimates that weigh the data differently partly cancel in the mean
/// (Bates and Granger 1969, "The combination of forecasts").
///
/// Orders and priors are chosen on all clips, as identify() does; then every estimate is made again per fold without
/// the clips it is judged on. `groups`, `diagnostics` and exceptions as in identify(), and for options out of range.
/// Cost some folds times that of its parts.
Combined identify_combined(const std::vector<Experiment>& experiments, const std::vector<int>& groups,
                           const CombineOptions& options = {}, Diagnostics* diagnostics = nullptr);

}  // namespace strut::sysid
