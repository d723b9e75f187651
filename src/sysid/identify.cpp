// SPDX-License-Identifier: MIT
// Identification in one call: balance, factor the Hankel data of every fold once, judge each order on the fold left
// out, then identify the chosen order from all clips.
#include "sysid/balance.h"
#include "sysid/block_rows.h"
#include "sysid/folds.h"
#include "sysid/left_out_fit.h"

#include <algorithm>
#include <optional>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/identify.h>
#include <strut/sysid/input_matrices.h>
#include <strut/sysid/order.h>
#include <strut/sysid/refine.h>
#include <strut/sysid/stability.h>
#include <strut/sysid/state_estimates.h>

namespace strut::sysid {
namespace {

using detail::FoldedClips;

constexpr const char* kWhere = "identification";
constexpr int kNone = -1;

void report(Diagnostics* diagnostics, Severity severity, std::string message, std::string hint = {}) {
  if (diagnostics == nullptr) return;
  severity == Severity::kNote ? diagnostics->note(kWhere, std::move(message), std::move(hint))
                              : diagnostics->warn(kWhere, std::move(message), std::move(hint));
}

void check_options(const IdentifyOptions& options) {
  if (options.max_order < 0) throw InvalidArgument("max_order", "0 or more", std::to_string(options.max_order));
  if (options.block_rows < detail::kLeastBlockRows) {
    throw InvalidArgument("block_rows", "2 or more", std::to_string(options.block_rows));
  }
  if (!(options.max_radius > 0.0 && options.max_radius < 1.0)) {
    throw InvalidArgument("max_radius", "above 0 and below 1", std::to_string(options.max_radius));
  }
  if (!(options.order_tolerance >= 0.0)) {
    throw InvalidArgument("order_tolerance", "0 or more", std::to_string(options.order_tolerance));
  }
  if (options.num_folds < 2) throw InvalidArgument("num_folds", "2 or more", std::to_string(options.num_folds));
  if (options.refine_iterations < 0) {
    throw InvalidArgument("refine_iterations", "0 or more", std::to_string(options.refine_iterations));
  }
}

int usable_block_rows(const FoldedClips& folded, int wanted, Diagnostics* diagnostics) {
  int usable = detail::usable_block_rows(folded.clips, wanted);
  for (int k = 0; k < folded.num_folds && folded.num_folds > 1; ++k) {
    usable = std::min(usable, detail::usable_block_rows(folded.select(k, false), usable));
  }
  if (usable == 0) {
    report(diagnostics, Severity::kWarning,
           "the clips are too few or too short for a system with states; a static map is used",
           "give more or longer examples");
  } else if (usable < wanted) {
    report(diagnostics, Severity::kNote,
           "short clips: " + std::to_string(usable) + " block rows instead of " + std::to_string(wanted));
  }
  return usable;
}

/// What systems are fitted to: clips, and what the subspace step makes of them.
struct Training {
  std::vector<Experiment> clips;
  std::optional<HankelFactor> factor;  // neither, where clips are too few or too short
  std::optional<Subspace> subspace;

  [[nodiscard]] int max_order() const { return subspace ? subspace->max_order() : 0; }
};

Training train(std::vector<Experiment> clips, std::optional<HankelFactor> factor, Weighting weighting) {
  Training training{std::move(clips), std::move(factor), {}};
  if (training.factor) training.subspace.emplace(*training.factor, weighting);
  return training;
}

LtiSystem fit_order(const Training& training, int order, const IdentifyOptions& options) {
  const Eigen::Index num_outputs = training.clips.front().output.cols();
  if (order == 0) {
    return fit_input_matrices(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(num_outputs, 0), training.clips, options.ridge);
  }
  const Subspace::AandC found = training.subspace->a_and_c(order);
  const Eigen::MatrixXd a = clip_eigenvalues(found.a, options.max_radius);
  if (options.input_matrices == InputMatrices::kSimulation) {
    return fit_input_matrices(a, found.c, training.clips, options.ridge);
  }
  return input_matrices_from_states(a, found.c, estimate_states(*training.factor, a, found.c));
}

LtiSystem refine(const LtiSystem& system, const Training& training, const IdentifyOptions& options) {
  return refine_system(
             system, training.clips,
             {.max_iterations = options.refine_iterations, .max_radius = options.max_radius, .from_rest = true})
      .system;
}

/// The Hankel factor of each fold's clips.
std::vector<HankelFactor> factor_folds(const FoldedClips& folded, int block_rows) {
  const Experiment& first = folded.clips.front();
  std::vector<HankelFactor> factors(folded.num_folds, HankelFactor(static_cast<int>(first.input.cols()),
                                                                   static_cast<int>(first.output.cols()), block_rows));
  for (std::size_t k = 0; k < folded.clips.size(); ++k) factors[folded.folds[k]].add(folded.clips[k]);
  return factors;
}

/// All folds' factors but that of `left_out` (or kNone) in one; nothing if there are none.
std::optional<HankelFactor> merge(const std::vector<HankelFactor>& factors, int left_out) {
  if (factors.empty()) return {};
  HankelFactor merged(factors.front().num_inputs(), factors.front().num_outputs(), factors.front().block_rows());
  for (int k = 0; k < static_cast<int>(factors.size()); ++k) {
    if (k != left_out) merged.add(factors[k]);
  }
  return merged;
}

/// Left-out fits per order, without refinement and with it (empty if that is not asked for).
struct LeftOutFits {
  std::vector<double> plain, refined;

  [[nodiscard]] bool refinement_helps(int order) const { return !refined.empty() && refined[order] > plain[order]; }
  /// Per order, the better of the two.
  [[nodiscard]] std::vector<double> best() const {
    std::vector<double> fits = plain;
    for (std::size_t k = 0; k < refined.size(); ++k) fits[k] = std::max(fits[k], refined[k]);
    return fits;
  }
};

/// Fits up to the largest order that every fold's data carry; of a static map only, if there are no factors. A single
/// clip of one frame cannot be left out of anything, and is judged on itself.
LeftOutFits left_out_fits(const FoldedClips& folded, const std::vector<HankelFactor>& factors,
                          const IdentifyOptions& options) {
  int max_order = factors.empty() ? 0 : options.max_order;
  const detail::LeftOutFit none(static_cast<int>(folded.clips.front().output.cols()), options.starts);
  std::vector<detail::LeftOutFit> plain(max_order + 1, none), refined(max_order + 1, none);
  for (int k = 0; k < folded.num_folds; ++k) {
    const std::vector<Experiment> test = folded.select(k, true);
    const Training training = train(folded.without(k), merge(factors, k), options.weighting);
    max_order = std::min(max_order, training.max_order());
    for (int order = 0; order <= max_order; ++order) {
      const LtiSystem system = fit_order(training, order, options);
      for (const Experiment& clip : test) plain[order].add(clip, system);
      if (options.refine_iterations == 0) continue;
      const LtiSystem better = refine(system, training, options);
      for (const Experiment& clip : test) refined[order].add(clip, better);
    }
  }
  LeftOutFits fits;
  for (int order = 0; order <= max_order; ++order) {
    fits.plain.push_back(plain[order].fit());
    if (options.refine_iterations > 0) fits.refined.push_back(refined[order].fit());
  }
  return fits;
}

int choose_order(const LeftOutFits& fits, const Training& training, const IdentifyOptions& options) {
  const int most = std::min(static_cast<int>(fits.plain.size()) - 1, training.max_order());
  switch (options.order_rule) {
    case OrderRule::kFixed:
      return most;
    case OrderRule::kGap:
      return training.subspace ? largest_gap(training.subspace->singular_values(), most) : 0;
    case OrderRule::kLeftOut:
      break;
  }
  return std::min(smallest_good_order(fits.best(), options.order_tolerance), most);
}

LtiSystem silent_system(const Experiment& clip, Diagnostics* diagnostics) {
  report(diagnostics, Severity::kWarning, "no input ever differs from zero; the output will be zero");
  const Eigen::Index m = clip.input.cols();
  const Eigen::Index l = clip.output.cols();
  return {Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, m), Eigen::MatrixXd(l, 0), Eigen::MatrixXd::Zero(l, m)};
}

}  // namespace

Identified identify(const std::vector<Experiment>& experiments, const std::vector<int>& groups,
                    const IdentifyOptions& options, Diagnostics* diagnostics) {
  check_experiments(experiments);
  check_options(options);
  detail::check_groups(experiments, groups);
  const detail::Balance balance(experiments);
  if (balance.num_directions() == 0) {
    const LtiSystem silent = silent_system(experiments.front(), diagnostics);
    const double fit = simulated_fit(silent, experiments);
    return {silent, fit, {fit}, {}, {}, false};
  }
  const FoldedClips folded =
      detail::fold_clips(balance.apply(experiments), groups, options.num_folds, options.max_radius, diagnostics);
  const int block_rows = options.max_order == 0 ? 0 : usable_block_rows(folded, options.block_rows, diagnostics);
  const std::vector<HankelFactor> factors =
      block_rows > 0 ? factor_folds(folded, block_rows) : std::vector<HankelFactor>();
  LeftOutFits fits = left_out_fits(folded, factors, options);
  const Training training = train(folded.clips, merge(factors, kNone), options.weighting);
  const int order = choose_order(fits, training, options);
  const double fit = fits.best()[order];
  const bool is_refined = fits.refinement_helps(order);
  LtiSystem system = fit_order(training, order, options);
  if (is_refined) system = refine(system, training, options);
  return {balance.undo(system),    fit,
          std::move(fits.plain),   training.subspace ? training.subspace->singular_values() : Eigen::VectorXd(),
          std::move(fits.refined), is_refined};
}

LtiSystem identify_order(const std::vector<Experiment>& experiments, int order, const IdentifyOptions& options,
                         Diagnostics* diagnostics) {
  check_experiments(experiments);
  check_options(options);
  if (order < 0) throw InvalidArgument("order", "0 or more", std::to_string(order));
  const detail::Balance balance(experiments);
  if (balance.num_directions() == 0) return silent_system(experiments.front(), diagnostics);
  const FoldedClips clips{balance.apply(experiments), std::vector<int>(experiments.size(), 0), 1};
  const int block_rows = order == 0 ? 0 : usable_block_rows(clips, options.block_rows, diagnostics);
  const Training training = train(
      clips.clips, block_rows > 0 ? merge(factor_folds(clips, block_rows), kNone) : std::nullopt, options.weighting);
  LtiSystem system = fit_order(training, std::min(order, training.max_order()), options);
  if (options.refine_iterations > 0) system = refine(system, training, options);
  return balance.undo(system);
}

}  // namespace strut::sysid
