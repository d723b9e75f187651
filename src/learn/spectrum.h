// SPDX-License-Identifier: MIT
// How smooth a radial map's output is: as smooth as real motion of the style.
#pragma once

#include "learn/examples.h"

#include <strut/model/style_model.h>

namespace strut::learn {

/// What shapes the fast part of the output; see RadialMap.
struct Spectrum {
  double smoothing = 0.0;  ///< [frames]
  double fast = 0.0;
};

/// The smoothing, if the map's output is rougher than the style, or the share of the input's fast detail, if it is
/// smoother, with which the examples' input clips, translated, come nearest to the mean jerk of their output clips.
/// `parts` hold a radial map.
Spectrum choose_spectrum(const Examples& examples, StyleModelParts parts);

}  // namespace strut::learn
