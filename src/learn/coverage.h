// SPDX-License-Identifier: MIT
// Says in plain words what the examples cover and what they do not.
#pragma once

#include "learn/examples.h"
#include "learn/pair_alignment.h"

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/learn/learn_report.h>

namespace strut::learn {

/// Fills in what the report says of the pairs `aligned`, which were learnt from: clips, speeds, turning, durations, how
/// many could be left out. Warns about what is missing: little motion, one speed, no turning or turning to one side
/// only, joints that the input hardly moves, recordings too few to leave one out.
void report_coverage(const Examples& examples, const std::vector<AlignedPair>& aligned, LearnReport& report,
                     Diagnostics* diagnostics);

}  // namespace strut::learn
