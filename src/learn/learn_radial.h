// SPDX-License-Identifier: MIT
// Learning a radial map: where the body may be in its movement, what both styles look like there, and how much of the
// input's own detail belongs on the output.
#pragma once

#include "learn/normalized_pairs.h"

#include <vector>

#include <strut/learn/learn_style.h>
#include <strut/model/radial_map.h>

namespace strut::learn {

struct LearntRadialMap {
  RadialMap map;
  std::vector<BlockReport> blocks;      ///< root, joints below it, timing
  std::vector<Eigen::VectorXd> timing;  ///< the normalized log time warp it gives on each pair (frames)
};

/// Fits the map to the pairs, whose inputs `context` looks at. The basis stands where the input style's contexts do;
/// weights are ridge regressions on it; detail is measured on pairs left out. `examples` give the clips, the body and
/// the frame rate. The result does not depend on the number of threads.
LearntRadialMap learn_radial_map(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                 const Scalings& scalings, const Eigen::MatrixXd& context,
                                 const RadialOptions& options);

}  // namespace strut::learn
