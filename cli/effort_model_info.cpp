// SPDX-License-Identifier: MIT
#include "effort_model_info.h"

#include "model_info.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/core.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;
using effort::EffortModel;

/// What is told of a group.
struct GroupFacts {
  int group = 0;
  int fragments = 0, pairs = 0, blends = 0;
  double seconds = 0.0;                                                  ///< of a fragment, in the mean
  std::array<double, effort::kNumPredictedFactors> least{}, greatest{};  ///< labels; kNotRated without one
  std::string example;                                                   ///< the name of its first fragment
};

GroupFacts facts_of(const EffortModel& model, int group) {
  GroupFacts facts;
  facts.group = group;
  facts.least.fill(effort::kNotRated);
  facts.greatest.fill(effort::kNotRated);
  facts.fragments = static_cast<int>(model.group(group).size());
  facts.example = model.fragment(model.group(group).front()).name;
  for (const int i : model.group(group)) {
    facts.seconds += model.fragment(i).motion.duration() / facts.fragments;
    for (int factor = 0; factor < effort::kNumPredictedFactors; ++factor) {
      const double label = model.fragment(i).effort[factor];
      if (!effort::is_rated(label)) continue;
      double& least = facts.least.at(static_cast<std::size_t>(factor));
      double& greatest = facts.greatest.at(static_cast<std::size_t>(factor));
      least = effort::is_rated(least) ? std::min(least, label) : label;
      greatest = effort::is_rated(greatest) ? std::max(greatest, label) : label;
    }
  }
  const auto is_here = [&](const auto& pair) { return model.fragment(pair.first).group == group; };
  facts.pairs = static_cast<int>(std::count_if(model.parts().pairs.begin(), model.parts().pairs.end(), is_here));
  const auto& blends = model.parts().regression.parts().blends;
  facts.blends = static_cast<int>(std::count_if(blends.begin(), blends.end(), is_here));
  return facts;
}

const char* method_name(const EffortModel& model) {
  return effort::kRegressionMethodNames.at(static_cast<std::size_t>(model.parts().regression.parts().method));
}

std::string counted(int number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string range(double least, double greatest) {
  return effort::is_rated(least) ? fmt::format("{:.2f} to {:.2f}", least, greatest) : "-";
}

/// Whose labels the model is learnt from.
const char* source_of(const EffortModel& model) {
  if (model.parts().are_estimates) return "the program's estimates";
  const Json provenance = provenance_as_json(model.parts().provenance);
  const auto synthetic = provenance.is_object() ? provenance.find("synthetic") : provenance.end();
  const bool is_synthetic = synthetic != provenance.end() && synthetic->is_boolean() && synthetic->get<bool>();
  return is_synthetic ? "a synthetic rater's labels" : "people's labels";
}

/// The groups in which something can be blended, the largest first.
std::vector<GroupFacts> groups_by_size(const EffortModel& model) {
  std::vector<GroupFacts> groups;
  for (int group = 0; group < model.num_groups(); ++group) {
    if (model.group(group).size() > 1) groups.push_back(facts_of(model, group));
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const GroupFacts& a, const GroupFacts& b) { return a.fragments > b.fragments; });
  return groups;
}

}  // namespace

void print_effort_model(const std::string& path, const EffortModel& model) {
  fmt::print("{}: effort model, {} joints, {:g} frames/s, learnt from {}\n", path, model.skeleton().num_joints(),
             model.frame_rate(), source_of(model));
  fmt::print("  method '{}', content is alike below {:.3f} m\n", method_name(model), model.parts().threshold);
  fmt::print("{:>6} {:>10} {:>7} {:>7} {:>8}  {:<14} {:<14} {:<14} {}\n", "group", "fragments", "pairs", "blends",
             "seconds", "flow", "weight", "time", "e.g.");
  constexpr std::size_t kMostShown = 20;
  const std::vector<GroupFacts> groups = groups_by_size(model);
  const std::size_t shown = std::min(kMostShown, groups.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const GroupFacts& facts = groups[i];
    fmt::print("{:>6} {:>10} {:>7} {:>7} {:>8.2f}  {:<14} {:<14} {:<14} {}\n", facts.group, facts.fragments,
               facts.pairs, facts.blends, facts.seconds, range(facts.least[0], facts.greatest[0]),
               range(facts.least[1], facts.greatest[1]), range(facts.least[2], facts.greatest[2]), facts.example);
  }
  if (shown < groups.size()) {
    fmt::print("  and {} smaller groups (strut info --json shows all)\n", groups.size() - shown);
  }
  const int alone = model.num_groups() - static_cast<int>(groups.size());
  if (alone > 0) fmt::print("  {} of one fragment: nothing there can be blended\n", counted(alone, "group"));
}

Json effort_model_as_json(const std::string& path, const EffortModel& model) {
  Json groups = Json::array();
  for (int group = 0; group < model.num_groups(); ++group) {
    const GroupFacts facts = facts_of(model, group);
    Json labels = Json::object();
    for (std::size_t factor = 0; factor < facts.least.size(); ++factor) {
      if (!effort::is_rated(facts.least.at(factor))) continue;
      labels[effort::kFactorNames.at(factor)] = {facts.least.at(factor), facts.greatest.at(factor)};
    }
    groups.push_back({{"fragments", facts.fragments},
                      {"pairs", facts.pairs},
                      {"labelled_blends", facts.blends},
                      {"mean_seconds", facts.seconds},
                      {"labels", std::move(labels)},
                      {"example", facts.example}});
  }
  return {{"file", path},
          {"kind", "effort model"},
          {"frame_rate", model.frame_rate()},
          {"num_joints", model.skeleton().num_joints()},
          {"method", method_name(model)},
          {"from_estimates", model.parts().are_estimates},
          {"threshold_m", model.parts().threshold},
          {"groups", std::move(groups)},
          {"provenance", provenance_as_json(model.parts().provenance)}};
}

}  // namespace strut::cli
