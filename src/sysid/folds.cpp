// SPDX-License-Identifier: MIT
#include "sysid/folds.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/order.h>

namespace strut::sysid::detail {
namespace {

std::vector<Experiment> cut(const Experiment& clip, int pieces, double max_radius) {
  constexpr double kForgotten = 1e-4;  // what a longer lead-in would change
  const double memory = std::ceil(std::log(kForgotten) / std::log(max_radius));
  const int longest = static_cast<int>(std::min<double>(clip.num_frames(), memory));
  std::vector<Experiment> cuts;
  for (int k = 0; k < pieces; ++k) {
    const int begin = clip.lead_in + static_cast<int>(static_cast<long>(clip.num_fitted()) * k / pieces);
    const int end = clip.lead_in + static_cast<int>(static_cast<long>(clip.num_fitted()) * (k + 1) / pieces);
    const int lead_in = std::min(begin, longest);
    if (end == begin) continue;
    cuts.push_back({clip.input.middleRows(begin - lead_in, end - begin + lead_in),
                    clip.output.middleRows(begin - lead_in, end - begin + lead_in), lead_in});
  }
  return cuts;
}

}  // namespace

std::vector<Experiment> FoldedClips::select(int fold, bool inside) const {
  std::vector<Experiment> selected;
  for (std::size_t k = 0; k < clips.size(); ++k) {
    if ((folds[k] == fold) == inside) selected.push_back(clips[k]);
  }
  return selected;
}

std::vector<int> FoldedClips::folds_without(int fold) const {
  std::vector<int> selected = folds;
  if (num_folds > 1) std::erase(selected, fold);
  return selected;
}

void check_groups(const std::vector<Experiment>& experiments, const std::vector<int>& groups) {
  if (groups.size() == experiments.size()) return;
  throw InvalidArgument("groups", std::to_string(experiments.size()) + " elements", std::to_string(groups.size()));
}

FoldedClips fold_clips(std::vector<Experiment> clips, std::vector<int> groups, int num_folds, double max_radius,
                       Diagnostics* diagnostics) {
  if (clips.size() == 1) {
    clips = cut(clips.front(), num_folds, max_radius);
    groups.assign(clips.size(), 0);
  }
  if (std::set<int>(groups.begin(), groups.end()).size() == 1) {
    if (diagnostics != nullptr) {
      diagnostics->note("identification", "the order is judged on clips related to those learnt from",
                        "give examples from several recordings");
    }
    for (std::size_t k = 0; k < groups.size(); ++k) groups[k] = static_cast<int>(k);
  }
  std::vector<int> frames;
  for (const Experiment& clip : clips) frames.push_back(clip.num_fitted());
  std::vector<int> folds = assign_folds(groups, frames, num_folds);
  const int used = *std::max_element(folds.begin(), folds.end()) + 1;
  return {std::move(clips), std::move(folds), used};
}

}  // namespace strut::sysid::detail
