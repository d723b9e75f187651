// SPDX-License-Identifier: MIT
// What the engine does with labels: how near to a wanted Effort the blend comes that it chooses, and how fast it learns
// when it says what to label.
#pragma once

#include "effort_prediction.h"

#include <array>
#include <string>
#include <vector>

namespace strut::study {

/// Every blend that could be chosen: all pairs of a content at alphas from -0.5 to 1.5.
std::vector<StudyBlend> all_candidates(const FragmentSet& set);

/// A way to choose, and the mean distance of what it gave, as the rater judges it without noise, from what was wanted.
struct ChoiceFigure {
  std::string name;
  double error = 0.0;
};

/// For `per_content` Efforts wanted of every content, each factor at random within [-0.8, 0.8]. `candidates` are also
/// what the best possible choice (the last figure) is made of.
std::vector<ChoiceFigure> judge_choices(const LabelledSet& labels, const Rater& rater,
                                        const std::vector<StudyBlend>& candidates, int per_content);

/// Held-out RMSE with 0, 20, 40 and 80 labelled blends.
struct LearningFigures {
  std::array<double, 4> at_random{}, asked_for{};
};
inline constexpr std::array<int, 4> kLabelCounts = {0, 20, 40, 80};

/// Blends are labelled that have neither fragment in the test fold; they are drawn at random (the mean of several
/// draws) or those that next_labels asks for, ten at a time.
LearningFigures judge_labelling(const LabelledSet& labels, const std::vector<Fold>& folds);

}  // namespace strut::study
