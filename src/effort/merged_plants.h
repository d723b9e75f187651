// SPDX-License-Identifier: MIT
// Footplants in order: what blends and joins return, whatever order they were made in.
#pragma once

#include <vector>

#include <strut/motion/annotation.h>

namespace strut::effort {

/// `plants` by foot, then begin; those of one foot that touch or overlap become one. Cost O(n log n).
std::vector<motion::Footplant> merged_plants(std::vector<motion::Footplant> plants);

}  // namespace strut::effort
