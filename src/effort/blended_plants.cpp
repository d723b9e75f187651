// SPDX-License-Identifier: MIT
#include "effort/blended_plants.h"

#include <algorithm>
#include <cstddef>

namespace strut::effort {
namespace {

double overlap(const TimedPlant& a, const TimedPlant& b) {
  return a.foot == b.foot ? std::min(a.end, b.end) - std::max(a.begin, b.begin) : 0.0;
}

/// The index of the plant among `others` that overlaps `plant` most; their number if none does.
std::size_t partner(const TimedPlant& plant, const std::vector<TimedPlant>& others) {
  std::size_t best = others.size();
  double most = 0.0;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const double shared = overlap(plant, others[i]);
    if (shared <= most) continue;
    most = shared;
    best = i;
  }
  return best;
}

}  // namespace

std::vector<PlantPair> match_plants(const std::vector<TimedPlant>& first, const std::vector<TimedPlant>& second) {
  std::vector<PlantPair> pairs;
  std::vector<bool> is_matched(second.size(), false);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::size_t other = partner(first[i], second);
    const bool both = other < second.size() && partner(second[other], first) == i;
    if (both) is_matched[other] = true;
    pairs.push_back({first[i], both ? second[other] : first[i], true, both});
  }
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (!is_matched[i]) pairs.push_back({second[i], second[i], false, true});
  }
  return pairs;
}

std::vector<TimedPlant> blended_plants(const std::vector<PlantPair>& pairs, double alpha) {
  std::vector<TimedPlant> plants;
  for (const PlantPair& pair : pairs) {
    if (!(alpha <= 0.5 ? pair.in_first : pair.in_second)) continue;
    const auto blend = [alpha](double a, double b) { return std::clamp((1.0 - alpha) * a + alpha * b, 0.0, 1.0); };
    const TimedPlant plant{pair.first.foot, blend(pair.first.begin, pair.second.begin),
                           blend(pair.first.end, pair.second.end)};
    if (plant.end > plant.begin) plants.push_back(plant);
  }
  return plants;
}

}  // namespace strut::effort
