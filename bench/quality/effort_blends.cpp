// SPDX-License-Identifier: MIT
#include "effort_blends.h"

#include <algorithm>
#include <random>

#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/effort/space_time_blend.h>

namespace strut::study {
namespace {

constexpr std::size_t kPairsOfAKind = 40;  // of one content, within folds and across: what a person might label

}  // namespace

Showing StudyBlend::showing(const FragmentSet& set) const {
  return {set.fragments[static_cast<std::size_t>(first)].group, cues, blend_id(first, second, alpha)};
}

std::vector<StudyBlend> make_blends(const FragmentSet& set, const std::vector<BlendPlan>& plans) {
  std::vector<std::vector<StudyBlend>> made(plans.size());
  tbb::parallel_for(std::size_t{0}, plans.size(), [&](std::size_t i) {
    const BlendPlan& plan = plans[i];
    try {
      const effort::SpaceTimeBlend pair(set.fragments[static_cast<std::size_t>(plan.first)].motion,
                                        set.fragments[static_cast<std::size_t>(plan.second)].motion);
      for (const double alpha : plan.alphas) {
        made[i].push_back({plan.first, plan.second, alpha, movement_cues(pair.at(alpha).motion)});
      }
    } catch (const InvalidArgument&) {
      made[i].clear();  // too unlike, or so exaggerated that nothing is left
    }
  });
  std::vector<StudyBlend> all;
  for (std::vector<StudyBlend>& blends : made) all.insert(all.end(), blends.begin(), blends.end());
  return all;
}

std::vector<int> fragment_folds(const FragmentSet& set, int num_folds, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<int> folds(set.fragments.size());
  for (int group = 0; group < static_cast<int>(set.contents.size()); ++group) {
    std::vector<int> members = set.group(group);
    std::shuffle(members.begin(), members.end(), random);
    for (std::size_t i = 0; i < members.size(); ++i) {
      folds[static_cast<std::size_t>(members[i])] = static_cast<int>(i) % num_folds;
    }
  }
  return folds;
}

std::vector<BlendPlan> plans_to_label(const FragmentSet& set, const std::vector<int>& folds, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<BlendPlan> plans;
  for (int group = 0; group < static_cast<int>(set.contents.size()); ++group) {
    std::vector<BlendPlan> within, across;
    for (const BlendPlan& pair : all_pairs(set, group, {})) {
      const bool same = folds[static_cast<std::size_t>(pair.first)] == folds[static_cast<std::size_t>(pair.second)];
      (same ? within : across).push_back(pair);
    }
    std::shuffle(within.begin(), within.end(), random);
    std::shuffle(across.begin(), across.end(), random);
    within.resize(std::min(within.size(), kPairsOfAKind));
    across.resize(std::min(across.size(), within.size()));
    within.insert(within.end(), across.begin(), across.end());
    plans.insert(plans.end(), within.begin(), within.end());
  }
  for (BlendPlan& plan : plans) {
    if (unit(random) < 0.5) std::swap(plan.first, plan.second);
    const double beyond = 0.1 + 0.4 * unit(random);
    plan.alphas = {0.1 + 0.8 * unit(random), unit(random) < 0.5 ? -beyond : 1.0 + beyond};
  }
  return plans;
}

std::vector<BlendPlan> all_pairs(const FragmentSet& set, int group, const std::vector<double>& alphas) {
  const std::vector<int> members = set.group(group);
  std::vector<BlendPlan> plans;
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (std::size_t k = i + 1; k < members.size(); ++k) plans.push_back({members[i], members[k], alphas});
  }
  return plans;
}

}  // namespace strut::study
