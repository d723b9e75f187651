// SPDX-License-Identifier: MIT
// Pairs of fragments of like content and their blends, with what raters see of them.
#pragma once

#include "effort_clips.h"
#include "effort_raters.h"

#include <vector>

namespace strut::study {

/// A blend that was made.
struct StudyBlend {
  int first = 0, second = 0;
  double alpha = 0.0;
  Eigen::VectorXd cues;

  [[nodiscard]] Showing showing(const FragmentSet& set) const;
  [[nodiscard]] bool is_outside() const { return alpha < 0.0 || alpha > 1.0; }
};

/// A pair, and the alphas at which it is to be blended.
struct BlendPlan {
  int first = 0, second = 0;
  std::vector<double> alphas;
};

/// What could be blended of the plans, in their order; pairs that do not fit are left out. Several threads.
std::vector<StudyBlend> make_blends(const FragmentSet& set, const std::vector<BlendPlan>& plans);

/// Every fragment's fold, 0 to `num_folds` - 1, as evenly as possible within every group.
std::vector<int> fragment_folds(const FragmentSet& set, int num_folds, std::uint64_t seed);

/// Pairs to be labelled: of each content 40 within one fold, and as many that are of two folds. Each once inside [0.1,
/// 0.9] and once outside, in [-0.5, -0.1] or [1.1, 1.5].
std::vector<BlendPlan> plans_to_label(const FragmentSet& set, const std::vector<int>& folds, std::uint64_t seed);

/// All pairs of a group, first before second, at `alphas`.
std::vector<BlendPlan> all_pairs(const FragmentSet& set, int group, const std::vector<double>& alphas);

}  // namespace strut::study
