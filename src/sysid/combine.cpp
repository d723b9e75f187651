// SPDX-License-Identifier: MIT
// Five estimates, the means of some of them, and the one that predicts clips left out best.
#include "sysid/balance.h"
#include "sysid/folds.h"
#include "sysid/left_out_fit.h"

#include <algorithm>
#include <bit>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/combine.h>
#include <strut/sysid/initial_state.h>
#include <strut/sysid/prefilter.h>
#include <strut/sysid/reduce.h>

namespace strut::sysid {
namespace {

using detail::FoldedClips;
using detail::LeftOutFit;

constexpr unsigned kNumEstimates = 5;
constexpr unsigned kNumSets = 1u << kNumEstimates;

bool has(unsigned set, unsigned estimate) {
  return (set >> estimate & 1u) != 0;
}

/// What is chosen once, on all clips.
struct Recipe {
  Identified plain, filtered;
  double correlation = 0.0;
};

IdentifyOptions no_refinement(IdentifyOptions options) {
  options.refine_iterations = 0;
  return options;
}

LtiSystem regularized(const std::vector<Experiment>& clips, const std::vector<int>& groups,
                      const CombineOptions& options) {
  std::vector<int> frames;
  for (const Experiment& clip : clips) frames.push_back(clip.num_fitted());
  const std::vector<int> one_set(static_cast<std::size_t>(clips.front().input.cols()), 0);
  const LeaveOut leave_out = leave_out_groups(groups, frames, options.identification.num_folds);
  return identify_regularized(clips, leave_out, one_set, options.regularization).system;
}

/// All estimates from these clips, in the order of Estimate.
std::vector<LtiSystem> estimates(const std::vector<Experiment>& clips, const std::vector<int>& groups,
                                 const Recipe& recipe, const CombineOptions& options) {
  const std::vector<Experiment> filtered = prefilter(clips, recipe.correlation);
  const auto subspace = [&](const std::vector<Experiment>& of, const Identified& found) {
    return identify_order(of, found.system.num_states(),
                          found.is_refined ? options.identification : no_refinement(options.identification));
  };
  return {subspace(clips, recipe.plain), subspace(filtered, recipe.filtered), regularized(clips, groups, options),
          regularized(filtered, groups, options), identify_order(clips, 0, no_refinement(options.identification))};
}

/// The left-out fit of the mean of every set of estimates; that of the empty set means nothing.
std::vector<double> left_out_fits(const FoldedClips& folded, const Recipe& recipe, const CombineOptions& options) {
  const Starts starts = options.identification.starts;
  std::vector<LeftOutFit> sums(kNumSets, LeftOutFit(static_cast<int>(folded.clips.front().output.cols()), starts));
  for (int k = 0; k < folded.num_folds; ++k) {
    const std::vector<LtiSystem> systems = estimates(folded.without(k), folded.folds_without(k), recipe, options);
    for (const Experiment& clip : folded.select(k, true)) {
      std::vector<std::vector<FrameMatrix>> answers;
      for (const LtiSystem& system : systems) answers.push_back(detail::responses(system, clip, starts));
      for (unsigned set = 1; set < kNumSets; ++set) {
        std::vector<FrameMatrix> mean;
        for (std::size_t s = 0; s < answers.front().size(); ++s) {
          FrameMatrix sum = FrameMatrix::Zero(clip.num_fitted(), clip.output.cols());
          for (unsigned e = 0; e < kNumEstimates; ++e) {
            if (has(set, e)) sum += answers[e][s];
          }
          mean.push_back(sum / std::popcount(set));
        }
        sums[set].add(clip, mean);
      }
    }
  }
  std::vector<double> fits;
  for (const LeftOutFit& sum : sums) fits.push_back(sum.fit());
  return fits;
}

/// The smallest set within the tolerance of the best; of several the best.
unsigned choose(const std::vector<double>& fits, double tolerance) {
  const double best = *std::max_element(fits.begin() + 1, fits.end());
  unsigned chosen = 0;
  for (unsigned set = 1; set < kNumSets; ++set) {
    if (!(fits[set] >= best - tolerance)) continue;
    const int fewer = chosen == 0 ? -1 : std::popcount(set) - std::popcount(chosen);
    if (fewer < 0 || (fewer == 0 && fits[set] > fits[chosen])) chosen = set;
  }
  return chosen;
}

Recipe recipe_of(const FoldedClips& folded, const Identified& first, const detail::Balance& balance,
                 const CombineOptions& options) {
  Identified plain = first;
  plain.system = balance.apply(first.system);
  const double correlation = error_correlation(plain.system, folded.clips);
  Identified filtered = identify(prefilter(folded.clips, correlation), folded.folds, options.identification);
  return {std::move(plain), std::move(filtered), correlation};
}

LtiSystem mean_of(unsigned set, const FoldedClips& folded, const Recipe& recipe, const CombineOptions& options) {
  if (set == 1) return recipe.plain.system;  // kSubspace alone, already made
  const std::vector<LtiSystem> all = estimates(folded.clips, folded.folds, recipe, options);
  std::vector<LtiSystem> some;
  for (unsigned e = 0; e < kNumEstimates; ++e) {
    if (has(set, e)) some.push_back(all[e]);
  }
  if (some.size() == 1) return some.front();
  return reduce_order(mean_system(some), options.max_states, options.reduction).system;
}

}  // namespace

Combined identify_combined(const std::vector<Experiment>& experiments, const std::vector<int>& groups,
                           const CombineOptions& options, Diagnostics* diagnostics) {
  check_experiments(experiments);
  detail::check_groups(experiments, groups);
  if (!(options.tolerance >= 0.0)) throw InvalidArgument("tolerance", "0 or more", std::to_string(options.tolerance));
  Identified first = identify(experiments, groups, options.identification, diagnostics);
  const detail::Balance balance(experiments);
  const bool is_slow = !forgets_initial_state(first.system.spectral_radius(), options.regularization.taps);
  if (experiments.size() == 1 || balance.num_directions() == 0 || is_slow) {
    LtiSystem system = first.system;
    const double fit = first.fit;
    return {std::move(system), fit, {Estimate::kSubspace}, {fit}, std::move(first), 0.0};
  }
  const FoldedClips folded = detail::fold_clips(balance.apply(experiments), groups, options.identification.num_folds,
                                                options.identification.max_radius, nullptr);
  const Recipe recipe = recipe_of(folded, first, balance, options);
  const std::vector<double> fits = left_out_fits(folded, recipe, options);
  const unsigned set = choose(fits, options.tolerance);
  std::vector<Estimate> chosen;
  std::vector<double> alone;
  for (unsigned e = 0; e < kNumEstimates; ++e) {
    if (has(set, e)) chosen.push_back(static_cast<Estimate>(e));
    alone.push_back(fits[1u << e]);
  }
  LtiSystem system = balance.undo(mean_of(set, folded, recipe, options));
  return {std::move(system), fits[set], std::move(chosen), std::move(alone), std::move(first), recipe.correlation};
}

}  // namespace strut::sysid
