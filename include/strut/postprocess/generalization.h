// SPDX-License-Identifier: MIT
// Heuristic generalization (Hsu et al. 2005, 4.5): how much of the original input is blended into the output where the
// input is unlike the examples, so that unfamiliar motion passes through instead of turning to noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strut::postprocess {

/// The paper's two parameters. docs/generalization.md plots them.
struct GeneralizationOptions {
  bool enabled = true;
  double confidence = 2.0;   ///< k_c, above 0: how far from the examples translation is trusted [deviations]
  double preference = 40.0;  ///< k_p, above 0: how strongly doubtful input is translated rather than passed through
  double fade = 0.1;         ///< reach of the smoothing of the blend over time [s], 0 or more
};

/// The share of the input, from 0 to 1, when a degree of freedom lies `deviation` standard deviations from the
/// examples' mean: Eq. 7 and 8, erf(deviation / (k_c sqrt 2))^k_p. It never falls as the deviation grows, so the
/// largest share over all degrees of freedom is that of the largest deviation.
inline double input_share(double deviation, const GeneralizationOptions& options) {
  if (!options.enabled) return 0.0;
  return std::pow(std::erf(deviation / (options.confidence * std::numbers::sqrt2)), options.preference);
}

}  // namespace strut::postprocess
