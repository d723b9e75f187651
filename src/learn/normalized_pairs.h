// SPDX-License-Identifier: MIT
// Aligned pairs in units of each style's deviation: what every method of learning starts from.
#pragma once

#include "learn/pair_alignment.h"

#include <vector>

#include <strut/representation/normalization.h>
#include <strut/sysid/order.h>

namespace strut::learn {

/// How both styles are brought to unit variance.
struct Scalings {
  representation::Normalization input;   // (dofs)
  representation::Normalization output;  // (dofs + 1)
};

/// The scalings over all pairs, without the lead-ins.
Scalings fit_scalings(const std::vector<AlignedPair>& aligned);

/// One pair, normalized.
struct NormalizedPair {
  FrameMatrix input;   ///< lead-in, then the pair (frames x dofs + contexts)
  FrameMatrix output;  ///< the pair alone (frames x dofs + 1)
};

/// The body's `count` first principal components of the normalized input, in units of the first one's deviation:
/// (count x dofs). Fewer if there are fewer degrees of freedom.
Eigen::MatrixXd fit_context(const std::vector<AlignedPair>& aligned, const Scalings& scalings, int count);

/// Normalizes the pairs and appends the contexts to the inputs.
std::vector<NormalizedPair> normalize_pairs(const std::vector<AlignedPair>& aligned, const Scalings& scalings,
                                            const Eigen::MatrixXd& context);

/// Rounds in which pairs are left out that share a clip, of input or output, with none of those learnt from.
sysid::LeaveOut leave_out(const std::vector<AlignedPair>& aligned);

}  // namespace strut::learn
