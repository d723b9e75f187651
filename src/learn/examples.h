// SPDX-License-Identifier: MIT
// The examples of both styles as signals at one frame rate: what alignment and identification work on.
#pragma once

#include <vector>

#include <strut/learn/clip_pair.h>
#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>
#include <strut/representation/representation.h>

namespace strut::learn {

/// All clips of one style.
struct StyleSignals {
  representation::Representation representation;
  std::vector<FrameMatrix> clips;        ///< each frames x dofs
  std::vector<FrameMatrix> stillness{};  ///< of the feet in each (representation::foot_stillness); none without legs
};

/// Both styles and the pairs between them, whose frames count at `frame_rate`.
struct Examples {
  double frame_rate;  ///< [frames/s]
  StyleSignals input, output;
  std::vector<ClipPair> pairs;
  std::vector<FrameMatrix> planted{};  ///< footplants of the output clips (footplant_marks); none where not known
};

/// Resamples the clips to `frame_rate`, fits each style's representation (one heading for both) and encodes the clips.
/// The pairs must name existing clips. Throws SkeletonMismatch if hierarchies differ.
Examples represent_examples(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs,
                            const std::vector<ClipPair>& pairs, double frame_rate);

/// The rows of `frames` of a clip (frames x dofs) after the `lead_in` rows before them, the clip continued backward
/// where it does not reach.
FrameMatrix with_lead_in(const FrameMatrix& clip, const FrameRange& frames, int lead_in);

}  // namespace strut::learn
