// SPDX-License-Identifier: MIT
// Learning to tell footplants from the model's state (Hsu et al. 2005, 4.5): the output style's footplants, brought to
// the input's frames by each pair's alignment, are what the states at those frames are labelled with.
#pragma once

#include "learn/normalized_pairs.h"

#include <optional>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/learn/learn_report.h>
#include <strut/model/style_model.h>

namespace strut::learn {

/// Where feet are planted in `clips`, which are the output style's of `examples`, at the examples' rate: 1 planted, 0
/// not, per clip (frames x 2 feet). `given`: by clip, at the clips' own rates; empty: found by the detector. Nothing is
/// returned, and a note is made, where a body has no legs. Throws InvalidArgument if `given` is of another number of
/// clips, or names frames or feet that do not exist.
std::vector<FrameMatrix> footplant_marks(const std::vector<Motion>& clips,
                                         const std::vector<std::vector<motion::Footplant>>& given,
                                         const Examples& examples, Diagnostics* diagnostics);

/// Trains the classifier of the model that `parts` make on the aligned pairs' footplants and puts it into them. Says
/// how well it does on pairs left out; their states are of the whole model. Nothing where the pairs have no footplants.
std::optional<FootplantReport> learn_footplants(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                                StyleModelParts& parts);

}  // namespace strut::learn
