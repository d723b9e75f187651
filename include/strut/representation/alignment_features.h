// SPDX-License-Identifier: MIT
// What alignment looks at in a motion: the bridge from representation (skeletons) to align (signals).
#pragma once

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>
#include <strut/representation/normalization.h>

namespace strut::representation {

/// Posture, not travel, in units of its own style's deviation: of encoded `rows` (frames x dofs of representation.h)
/// the degrees of freedom from the root's height on, normalized by `own`. Those that hardly move in either style (`own`
/// or `other`) say nothing about when and become zero. Returns (frames x dofs less the root's three velocities).
FrameMatrix alignment_features(const FrameMatrix& rows, const Normalization& own, const Normalization& other);

/// The features of two motions.
struct AlignmentPair {
  FrameMatrix input, output;  ///< (frames x dofs)
};

/// In what units two motions are compared.
enum class StyleUnits {
  kOwn,     ///< each about its own mean orientations, in its own deviation: what is left is mostly timing
  kShared,  ///< both about one mean and in one deviation: postures as they are, a different style is a different number
};

/// The features of two motions that are all there is of their styles. One hierarchy and one frame rate.
/// Throws InvalidArgument if one has no frame, SkeletonMismatch if the hierarchies differ. Cost O(frames x joints).
AlignmentPair alignment_features(const Motion& input, const Motion& output, StyleUnits units = StyleUnits::kOwn);

}  // namespace strut::representation
