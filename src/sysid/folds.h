// SPDX-License-Identifier: MIT
// Private to identification: clips sorted into folds that are left out in turn.
#pragma once

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/sysid/experiment.h>

namespace strut::sysid::detail {

/// Clips and the fold each belongs to.
struct FoldedClips {
  std::vector<Experiment> clips;
  std::vector<int> folds;
  int num_folds = 1;

  /// The clips of `fold`, or all others.
  [[nodiscard]] std::vector<Experiment> select(int fold, bool inside) const;
  /// What to learn from when `fold` is left out: all others, or, if there is only one fold, that.
  [[nodiscard]] std::vector<Experiment> without(int fold) const { return select(fold, num_folds == 1); }
  /// The folds of those clips.
  [[nodiscard]] std::vector<int> folds_without(int fold) const;
};

/// Throws InvalidArgument unless `groups` has an element per clip.
void check_groups(const std::vector<Experiment>& experiments, const std::vector<int>& groups);

/// Clips of one group share a fold. With one group only, its clips are left out one by one; one clip only is cut into
/// consecutive pieces, each with what came before it as its lead-in, as far back as a system of `max_radius` remembers.
/// Notes that to `diagnostics`, if given.
FoldedClips fold_clips(std::vector<Experiment> clips, std::vector<int> groups, int num_folds, double max_radius,
                       Diagnostics* diagnostics);

}  // namespace strut::sysid::detail
