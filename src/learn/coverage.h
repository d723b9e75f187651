// SPDX-License-Identifier: MIT
// Says in plain words what the examples cover and what they do not.
#pragma once

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/learn/learn_style.h>

namespace strut::learn {

/// Fills in the report's ranges of speed and turning over the pairs of `signals` (the input clips in the
/// representation, frames x dofs), and warns about what is missing: little motion, one speed, no turning or turning to
/// one side only, joints that the input hardly moves, joints whose left-out fit is poor.
void report_coverage(const std::vector<FrameMatrix>& signals, const std::vector<ClipPair>& pairs, LearnReport& report,
                     Diagnostics* diagnostics);

}  // namespace strut::learn
