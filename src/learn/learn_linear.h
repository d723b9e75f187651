// SPDX-License-Identifier: MIT
// Learning a linear system per part of the body (Hsu et al. 2005, 4.2 and 4.3).
#pragma once

#include "learn/examples.h"
#include "learn/normalized_pairs.h"

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/learn/learn_style.h>
#include <strut/model/style_model.h>

namespace strut::learn {

/// Identifies a block per part of the body, in parallel: root, joints, timing. Fills in the report's blocks and the
/// joints that cannot be translated, and reports what identification had to do without. `pairs` are `aligned`
/// normalized, with `num_contexts` contexts behind the inputs. Throws InvalidArgument if nothing moves.
std::vector<StyleBlock> identify_blocks(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                        const std::vector<NormalizedPair>& pairs, const Scalings& scalings,
                                        int num_contexts, const LearnOptions& options, LearnReport& report,
                                        Diagnostics* diagnostics, const Progress& progress);

}  // namespace strut::learn
