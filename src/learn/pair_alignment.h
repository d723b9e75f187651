// SPDX-License-Identifier: MIT
// Every pair's output warped onto its input, with the timing that was taken out kept as one more column.
#pragma once

#include "learn/examples.h"

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/learn/learn_style.h>

namespace strut::learn {

/// One pair in the input's time.
struct AlignedPair {
  int input_clip = 0;  ///< index into the examples' clips
  int output_clip = 0;
  FrameRange input_frames;  ///< of the input clip
  FrameMatrix input;        ///< lead-in, then the pair (frames x dofs)
  FrameMatrix output;  ///< the pair alone (frames x dofs + 1): the last column is the log of the differential time warp
  FrameMatrix planted{};  ///< the output's footplants: 1 planted, 0 not (frames x 2 feet); no rows where not known
};

/// Frames of input before each pair that the model runs over first.
int lead_in_frames(const LearnOptions& options, double frame_rate);

/// Aligns every pair as the options ask, in parallel. Pairs that cannot be aligned, or that run along their
/// slope limit, are left out and reported. Throws InvalidArgument if none is left.
std::vector<AlignedPair> align_pairs(const Examples& examples, const LearnOptions& options, Diagnostics* diagnostics,
                                     const Progress& progress);

}  // namespace strut::learn
