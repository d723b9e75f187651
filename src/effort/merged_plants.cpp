// SPDX-License-Identifier: MIT
#include "effort/merged_plants.h"

#include <algorithm>
#include <tuple>

namespace strut::effort {

std::vector<motion::Footplant> merged_plants(std::vector<motion::Footplant> plants) {
  std::sort(plants.begin(), plants.end(),
            [](const auto& a, const auto& b) { return std::tie(a.foot, a.begin) < std::tie(b.foot, b.begin); });
  std::vector<motion::Footplant> merged;
  for (const motion::Footplant& plant : plants) {
    if (!merged.empty() && merged.back().foot == plant.foot && merged.back().end >= plant.begin) {
      merged.back().end = std::max(merged.back().end, plant.end);
    } else {
      merged.push_back(plant);
    }
  }
  return merged;
}

}  // namespace strut::effort
