// SPDX-License-Identifier: MIT
// Do walks of one content in seven styles correspond better pair by pair, by way of one of them, or by way of a
// timeline that all have in common (align/groupwise.h)?
#pragma once

#include "correspondence_methods.h"

#include <vector>

#include <strut/generate/walker.h>

namespace strut::study {

/// Errors of every walk's correspondence with every other that `method` can align directly, found in three ways.
struct GroupFigures {
  Figures direct;     ///< the two by themselves
  Figures reference;  ///< each with the group's first walk
  Figures timeline;   ///< each with the group's timeline
};

/// `method` on the posture of each walk in its own units, over all groups.
GroupFigures judge_groups(const Method& method, const std::vector<std::vector<generate::Walk>>& groups);

}  // namespace strut::study
