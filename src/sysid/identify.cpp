// SPDX-License-Identifier: MIT
// Identification in one call: balance, factor the Hankel data of every fold once, judge each order on the fold left
// out, then identify the chosen order from all clips.
#include "sysid/balance.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/identify.h>
#include <strut/sysid/input_matrices.h>
#include <strut/sysid/order.h>
#include <strut/sysid/stability.h>

namespace strut::sysid {
namespace {

constexpr const char* kWhere = "identification";
constexpr int kNone = -1;
constexpr int kLeastBlockRows = 2;  // one to see the states, one to see them move

void report(Diagnostics* diagnostics, Severity severity, std::string message, std::string hint = {}) {
  if (diagnostics == nullptr) return;
  severity == Severity::kNote ? diagnostics->note(kWhere, std::move(message), std::move(hint))
                              : diagnostics->warn(kWhere, std::move(message), std::move(hint));
}

void check_options(const IdentifyOptions& options) {
  if (options.max_order < 0) throw InvalidArgument("max_order", "0 or more", std::to_string(options.max_order));
  if (options.block_rows < kLeastBlockRows) {
    throw InvalidArgument("block_rows", "2 or more", std::to_string(options.block_rows));
  }
  if (!(options.max_radius > 0.0 && options.max_radius < 1.0)) {
    throw InvalidArgument("max_radius", "above 0 and below 1", std::to_string(options.max_radius));
  }
  if (!(options.order_tolerance >= 0.0)) {
    throw InvalidArgument("order_tolerance", "0 or more", std::to_string(options.order_tolerance));
  }
  if (options.num_folds < 2) throw InvalidArgument("num_folds", "2 or more", std::to_string(options.num_folds));
}

/// Clips and the fold each belongs to.
struct FoldedClips {
  std::vector<Experiment> clips;
  std::vector<int> folds;
  int num_folds = 1;

  /// The clips of `fold`, or all others.
  [[nodiscard]] std::vector<Experiment> select(int fold, bool inside) const {
    std::vector<Experiment> selected;
    for (std::size_t k = 0; k < clips.size(); ++k) {
      if ((folds[k] == fold) == inside) selected.push_back(clips[k]);
    }
    return selected;
  }
};

/// Consecutive pieces of one clip, each with what came before it as its lead-in.
std::vector<Experiment> cut(const Experiment& clip, int pieces) {
  constexpr int kLongestLeadIn = 500;  // 0.98 ^ 500 = 4e-5: more changes nothing
  std::vector<Experiment> cuts;
  for (int k = 0; k < pieces; ++k) {
    const int begin = clip.lead_in + static_cast<int>(static_cast<long>(clip.num_fitted()) * k / pieces);
    const int end = clip.lead_in + static_cast<int>(static_cast<long>(clip.num_fitted()) * (k + 1) / pieces);
    const int lead_in = std::min(begin, kLongestLeadIn);
    if (end == begin) continue;
    cuts.push_back({clip.input.middleRows(begin - lead_in, end - begin + lead_in),
                    clip.output.middleRows(begin - lead_in, end - begin + lead_in), lead_in});
  }
  return cuts;
}

FoldedClips fold(std::vector<Experiment> clips, std::vector<int> groups, int num_folds, Diagnostics* diagnostics) {
  if (clips.size() == 1) {
    clips = cut(clips.front(), num_folds);
    groups.assign(clips.size(), 0);
  }
  if (std::set<int>(groups.begin(), groups.end()).size() == 1) {
    report(diagnostics, Severity::kNote, "the order is judged on clips related to those learnt from",
           "give examples from several recordings");
    for (std::size_t k = 0; k < groups.size(); ++k) groups[k] = static_cast<int>(k);
  }
  std::vector<int> frames;
  for (const Experiment& clip : clips) frames.push_back(clip.num_fitted());
  std::vector<int> folds = assign_folds(groups, frames, num_folds);
  const int used = *std::max_element(folds.begin(), folds.end()) + 1;
  return {std::move(clips), std::move(folds), used};
}

long hankel_columns(const std::vector<Experiment>& clips, int block_rows) {
  long columns = 0;
  for (const Experiment& clip : clips) columns += std::max(0, clip.num_fitted() - 2 * block_rows + 1);
  return columns;
}

/// The most block rows, at most `wanted`, for which the clips give twice as many Hankel columns as the projections
/// have regressors; 0 if even the fewest do not.
int usable_block_rows(const std::vector<Experiment>& clips, int wanted) {
  constexpr long kColumnsPerRegressor = 2;
  const Eigen::Index regressors = 2 * clips.front().input.cols() + clips.front().output.cols();
  for (int i = wanted; i >= kLeastBlockRows; --i) {
    if (hankel_columns(clips, i) >= kColumnsPerRegressor * i * regressors) return i;
  }
  return 0;
}

int usable_block_rows(const FoldedClips& folded, int wanted, Diagnostics* diagnostics) {
  int usable = usable_block_rows(folded.clips, wanted);
  for (int k = 0; k < folded.num_folds && folded.num_folds > 1; ++k) {
    usable = std::min(usable, usable_block_rows(folded.select(k, false), usable));
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

LtiSystem fit_order(const std::optional<Subspace>& subspace, int order, const std::vector<Experiment>& clips,
                    const IdentifyOptions& options) {
  const Eigen::Index num_outputs = clips.front().output.cols();
  if (order == 0)
    return fit_input_matrices(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(num_outputs, 0), clips, options.ridge);
  const Subspace::AandC found = subspace->a_and_c(order);
  return fit_input_matrices(clip_eigenvalues(found.a, options.max_radius), found.c, clips, options.ridge);
}

/// The Hankel factor of each fold's clips.
std::vector<HankelFactor> factor_folds(const FoldedClips& folded, int block_rows) {
  const Experiment& first = folded.clips.front();
  std::vector<HankelFactor> factors(folded.num_folds, HankelFactor(static_cast<int>(first.input.cols()),
                                                                   static_cast<int>(first.output.cols()), block_rows));
  for (std::size_t k = 0; k < folded.clips.size(); ++k) factors[folded.folds[k]].add(folded.clips[k]);
  return factors;
}

/// All folds' factors but that of `left_out` (or kNone) in one.
HankelFactor merge(const std::vector<HankelFactor>& factors, int left_out) {
  HankelFactor merged(factors.front().num_inputs(), factors.front().num_outputs(), factors.front().block_rows());
  for (int k = 0; k < static_cast<int>(factors.size()); ++k) {
    if (k != left_out) merged.add(factors[k]);
  }
  return merged;
}

/// Left-out fit per order, up to the largest order that every fold's data carry; of a static map only, if there are
/// no factors. A single clip of one frame cannot be left out of anything, and is judged on itself.
std::vector<double> left_out_fits(const FoldedClips& folded, const std::vector<HankelFactor>& factors,
                                  const IdentifyOptions& options) {
  int max_order = factors.empty() ? 0 : options.max_order;
  std::vector<FitSum> sums(max_order + 1, FitSum(static_cast<int>(folded.clips.front().output.cols())));
  for (int k = 0; k < folded.num_folds; ++k) {
    const std::vector<Experiment> test = folded.select(k, true);
    const std::vector<Experiment> train = folded.num_folds > 1 ? folded.select(k, false) : test;
    std::optional<Subspace> subspace;
    if (max_order > 0) {
      subspace.emplace(merge(factors, k), options.weighting);
      max_order = std::min(max_order, subspace->max_order());
    }
    for (int order = 0; order <= max_order; ++order) {
      const LtiSystem system = fit_order(subspace, order, train, options);
      for (const Experiment& clip : test) sums[order].add(clip, simulate(system, clip.input));
    }
  }
  std::vector<double> fits;
  for (int order = 0; order <= max_order; ++order) fits.push_back(sums[order].fit());
  return fits;
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
  if (groups.size() != experiments.size()) {
    throw InvalidArgument("groups", std::to_string(experiments.size()) + " elements", std::to_string(groups.size()));
  }
  const detail::Balance balance(experiments);
  if (balance.num_directions() == 0) {
    const LtiSystem silent = silent_system(experiments.front(), diagnostics);
    const double fit = simulated_fit(silent, experiments);
    return {silent, fit, {fit}, {}};
  }
  const FoldedClips folded = fold(balance.apply(experiments), groups, options.num_folds, diagnostics);
  const int block_rows = options.max_order == 0 ? 0 : usable_block_rows(folded, options.block_rows, diagnostics);
  std::vector<double> fits;
  std::optional<Subspace> subspace;
  if (block_rows > 0) {
    const std::vector<HankelFactor> factors = factor_folds(folded, block_rows);
    fits = left_out_fits(folded, factors, options);
    subspace.emplace(merge(factors, kNone), options.weighting);
  } else {
    fits = left_out_fits(folded, {}, options);
  }
  int order = smallest_good_order(fits, options.order_tolerance);
  const double fit = fits[order];
  if (subspace) order = std::min(order, subspace->max_order());
  return {balance.undo(fit_order(subspace, order, folded.clips, options)), fit, std::move(fits),
          subspace ? subspace->singular_values() : Eigen::VectorXd()};
}

LtiSystem identify_order(const std::vector<Experiment>& experiments, int order, const IdentifyOptions& options,
                         Diagnostics* diagnostics) {
  check_experiments(experiments);
  check_options(options);
  if (order < 0) throw InvalidArgument("order", "0 or more", std::to_string(order));
  const detail::Balance balance(experiments);
  if (balance.num_directions() == 0) return silent_system(experiments.front(), diagnostics);
  const FoldedClips clips{balance.apply(experiments), std::vector<int>(experiments.size(), 0), 1};
  std::optional<Subspace> subspace;
  const int block_rows = order == 0 ? 0 : usable_block_rows(clips, options.block_rows, diagnostics);
  if (block_rows > 0) subspace.emplace(merge(factor_folds(clips, block_rows), kNone), options.weighting);
  const int carried = subspace ? std::min(order, subspace->max_order()) : 0;
  return balance.undo(fit_order(subspace, carried, clips.clips, options));
}

}  // namespace strut::sysid
