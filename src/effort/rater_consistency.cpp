// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>

#include <strut/effort/rater_consistency.h>

namespace strut::effort {
namespace {

/// What the rater said of every target when it was shown for the first time.
std::map<LabelTarget, Rating> first_ratings(const std::vector<LabelRecord>& labels, const std::string& rater) {
  std::map<LabelTarget, Rating> first;
  for (const LabelRecord& label : labels) {
    if (label.rater == rater && !label.is_repeat) first.emplace(label.target, label.rating);
  }
  return first;
}

}  // namespace

RaterConsistency rater_consistency(const std::vector<LabelRecord>& labels, const std::string& rater) {
  const std::map<LabelTarget, Rating> first = first_ratings(labels, rater);
  RaterConsistency result;
  Rating sum = Rating::Zero(), squares = Rating::Zero();
  for (const LabelRecord& label : labels) {
    if (label.rater != rater) continue;
    ++result.num_labels;
    result.is_synthetic |= label.source == LabelSource::kSynthetic;
    const auto before = first.find(label.target);
    if (!label.is_repeat || before == first.end()) continue;
    ++result.num_repeats;
    for (int k = 0; k < kNumFactors; ++k) {
      const double change = label.rating[k] - before->second[k];
      if (!is_rated(change)) continue;
      sum[k] += std::abs(change);
      squares[k] += change * change;
      ++result.num_compared[k];
    }
  }
  for (int k = 0; k < kNumFactors; ++k) {
    if (result.num_compared[k] == 0) continue;
    result.mean_difference[k] = sum[k] / result.num_compared[k];
    result.rms_difference[k] = std::sqrt(squares[k] / result.num_compared[k]);
  }
  return result;
}

}  // namespace strut::effort
