// SPDX-License-Identifier: MIT
// Checks what it is given; the work is done by the search for a prior (prior_search.h) and by balanced truncation.
#include "sysid/prior_search.h"

#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/sysid/regularized.h>

namespace strut::sysid {
namespace {

void check(const std::vector<Experiment>& experiments, const LeaveOut& leave_out, const std::vector<int>& input_sets,
           const RegularizedOptions& options) {
  check_experiments(experiments);
  for (const std::vector<Role>& round : leave_out.rounds) {
    if (round.size() == experiments.size()) continue;
    throw InvalidArgument("leave_out", std::to_string(experiments.size()) + " clips", std::to_string(round.size()));
  }
  if (static_cast<Eigen::Index>(input_sets.size()) != experiments.front().input.cols()) {
    throw InvalidArgument("input_sets", std::to_string(experiments.front().input.cols()) + " elements",
                          std::to_string(input_sets.size()));
  }
  for (const int set : input_sets) {
    if (set < 0 || set >= static_cast<int>(input_sets.size())) {
      throw InvalidArgument("input_sets", "sets from 0 to " + std::to_string(input_sets.size() - 1),
                            std::to_string(set));
    }
  }
  if (options.taps < 1) throw InvalidArgument("taps", "1 or more", std::to_string(options.taps));
  check_truncation_options(options.truncation);
}

}  // namespace

Regularized identify_regularized(const std::vector<Experiment>& experiments, const LeaveOut& leave_out,
                                 const std::vector<int>& input_sets, const RegularizedOptions& options) {
  check(experiments, leave_out, input_sets, options);
  const detail::RoundSums sums(experiments, leave_out, options.taps);
  detail::PriorSearch search(sums, input_sets, options);
  const PriorParameters prior = search.search();
  TruncatedSystem truncated = balanced_truncation(search.estimate(prior), options.truncation);
  return {std::move(truncated.system), search.left_out_fit(prior), prior, truncated.error};
}

}  // namespace strut::sysid
