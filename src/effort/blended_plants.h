// SPDX-License-Identifier: MIT
// When feet are planted in a blend: footplants of both fragments, brought to their common time, matched and blended.
#pragma once

#include <vector>

#include <strut/motion/annotation.h>

namespace strut::effort {

/// A footplant in the common time of two fragments.
struct TimedPlant {
  int foot = 0;
  double begin = 0.0, end = 0.0;  ///< u of the first and the last frame, 0 ... 1
};

/// A footplant of a blend's making: of both fragments, or of one that has no counterpart in the other.
struct PlantPair {
  TimedPlant first, second;
  bool in_first = true, in_second = true;
};

/// Plants of one foot belong together where each overlaps the other most; the others stand alone. Cost O(plants^2).
std::vector<PlantPair> match_plants(const std::vector<TimedPlant>& first, const std::vector<TimedPlant>& second);

/// Begins and ends blended in u; a plant that stands alone is there while its fragment is the nearer one. Ends beyond
/// the fragment are cut; what does not last is left out.
std::vector<TimedPlant> blended_plants(const std::vector<PlantPair>& pairs, double alpha);

}  // namespace strut::effort
