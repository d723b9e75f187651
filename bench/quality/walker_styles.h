// SPDX-License-Identifier: MIT
// The styles of the generated walks that studies are made on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <strut/generate/walker.h>

namespace strut::study {

/// Six styles, each far from the plain walk in its own way, and their names.
std::vector<std::pair<std::string, generate::WalkStyle>> walker_styles();

}  // namespace strut::study
