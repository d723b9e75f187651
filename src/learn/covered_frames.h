// SPDX-License-Identifier: MIT
// The frames of input that pairs cover, each once: the gait cycles of the two feet overlap, and every cycle is in
// several pairs, but what a radial basis makes of a frame is the same in all of them.
#pragma once

#include "learn/normalized_pairs.h"

#include <vector>

namespace strut::learn {

/// Neighbouring columns of CoveredFrames: a stretch of a clip.
struct Columns {
  Eigen::Index first = 0, count = 0;
};

struct CoveredFrames {
  Eigen::MatrixXd features;      ///< contexts at every lag, the newest first (lags x contexts x frames)
  Eigen::MatrixXd input;         ///< normalized (dofs x frames)
  std::vector<Columns> of_pair;  ///< where each pair's frames are

  [[nodiscard]] Eigen::Index size() const { return input.cols(); }
};

/// `context` as fit_context gives it; `lags` rise from 0 [frames]. Before a clip's first frame it is continued
/// backward.
CoveredFrames cover_frames(const Examples& examples, const std::vector<AlignedPair>& aligned, const Scalings& scalings,
                           const Eigen::MatrixXd& context, const std::vector<int>& lags);

}  // namespace strut::learn
