// SPDX-License-Identifier: MIT
#include "align_events.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace strut::cli {
namespace {

std::vector<OnsetPair> onsets_of(const std::vector<motion::Footplant>& plants) {
  std::vector<OnsetPair> onsets;
  for (const motion::Footplant& plant : plants) {
    if (plant.begin > 0) onsets.push_back({plant.foot, static_cast<double>(plant.begin), 0.0, 0.0, false});
  }
  std::sort(onsets.begin(), onsets.end(), [](const OnsetPair& a, const OnsetPair& b) {
    return std::pair(a.foot, a.input) < std::pair(b.foot, b.input);
  });
  return onsets;
}

/// The index of the onset of `foot` whose `place` is nearest to `to`, the earlier of two; -1 if there is none.
/// `onsets` are in the order of foot and place.
template <typename Place>
int nearest(const std::vector<OnsetPair>& onsets, int foot, double to, Place place) {
  const auto after = std::partition_point(onsets.begin(), onsets.end(), [&](const OnsetPair& onset) {
    return onset.foot < foot || (onset.foot == foot && place(onset) < to);
  });
  const bool has_after = after != onsets.end() && after->foot == foot;
  const bool has_before = after != onsets.begin() && std::prev(after)->foot == foot;
  if (!has_after && !has_before) return -1;
  const bool is_before = has_before && (!has_after || to - place(*std::prev(after)) <= place(*after) - to);
  return static_cast<int>(after - onsets.begin()) - (is_before ? 1 : 0);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

OnsetErrors onset_errors(const std::vector<motion::Footplant>& input, const std::vector<motion::Footplant>& output,
                         const Eigen::VectorXd& output_time) {
  OnsetErrors result;
  result.onsets = onsets_of(input);
  std::vector<OnsetPair> targets = onsets_of(output);
  for (OnsetPair& target : targets) target.output = target.input;
  for (OnsetPair& onset : result.onsets) onset.mapped = output_time[static_cast<Eigen::Index>(onset.input)];
  double sum = 0.0;
  for (std::size_t i = 0; i < result.onsets.size(); ++i) {
    OnsetPair& onset = result.onsets[i];
    const int j = nearest(targets, onset.foot, onset.mapped, [](const OnsetPair& o) { return o.output; });
    if (j < 0) continue;
    OnsetPair& target = targets[static_cast<std::size_t>(j)];
    const int back = nearest(result.onsets, onset.foot, target.output, [](const OnsetPair& o) { return o.mapped; });
    if (back != static_cast<int>(i)) continue;
    onset.output = target.output;
    onset.is_paired = target.is_paired = true;
    ++result.num_pairs;
    sum += std::abs(onset.error());
    result.largest = std::max(result.largest, std::abs(onset.error()));
  }
  if (result.num_pairs > 0) result.mean = sum / result.num_pairs;
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(result.unpaired),
               [](const OnsetPair& target) { return !target.is_paired; });
  return result;
}

double cycle_length(const std::vector<motion::Footplant>& plants) {
  std::vector<OnsetPair> onsets = onsets_of(plants);
  std::sort(onsets.begin(), onsets.end(), [](const OnsetPair& a, const OnsetPair& b) { return a.input < b.input; });
  std::vector<double> cycles, steps;
  double last[2] = {-1.0, -1.0};
  for (const OnsetPair& onset : onsets) {
    const double own = last[onset.foot], other = last[1 - onset.foot];
    if (own >= 0.0) cycles.push_back(onset.input - own);
    if (other > own) steps.push_back(2.0 * (onset.input - other));
    last[onset.foot] = onset.input;
  }
  return median(cycles.empty() ? steps : cycles);
}

}  // namespace strut::cli
