// SPDX-License-Identifier: MIT
// What alignment looks at in a motion: the bridge from representation (skeletons) to align (signals). The paper looks
// at posture. Posture alone says little about the moments in which a foot comes down or leaves, so two more groups of
// signals can be looked at beside it: how posture changes, and how still the feet are.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/motion/legs.h>
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

/// How still each foot's toe is, 0 ... 1, from how it moves over the ground (frames x 2: left, right):
/// 1 / (1 + (v / v0)^2), with the speed v over 1/15 s and v0 a fifth of the clip's own fast swing or, if that is more,
/// 0.15 leg lengths a second. A number without threshold, in which a landing is a rise of a few frames and a lift-off a
/// fall. Throws InvalidArgument if the motion is empty. Cost O(frames x joints).
FrameMatrix foot_stillness(const Motion& motion, const motion::Legs& legs);

/// What the groups of signals count, together, in the distance of two frames; 0 leaves movement or feet out.
struct FeatureShares {
  double posture = 1.0;   ///< alignment_features above
  double movement = 0.5;  ///< how fast each of those changes, in its own style's deviation
  double feet = 4.0;      ///< foot_stillness, in one unit for both styles
};

/// The clips of one style.
struct StyleClips {
  std::vector<FrameMatrix> rows;       ///< encoded (representation.h), each frames x dofs
  std::vector<FrameMatrix> stillness;  ///< foot_stillness of each, or nothing for a body without legs
};

/// What alignment looks at in every clip of two styles.
struct TimingFeatures {
  std::vector<FrameMatrix> input, output;  ///< of every clip (frames x dofs), at the clip's own frames
  Eigen::VectorXd weights;                 ///< what each degree of freedom counts, >= 0; all 0 if nothing moves (dofs)
};

/// Posture, movement and stillness of all clips of two styles; degrees of freedom that hardly change in one of the
/// styles count nothing, and a group's share is parted evenly among those that do. `frame_rate` [frames/s] of all.
/// Throws InvalidArgument if a style has no frame, sizes do not fit, a share is negative, or the rate is not positive.
/// Cost O(frames x dofs).
TimingFeatures timing_features(const StyleClips& input, const StyleClips& output, double frame_rate,
                               const FeatureShares& shares = {});

/// The same of two motions.
struct TimingPair {
  FrameMatrix input, output;  ///< (frames x dofs)
  Eigen::VectorXd weights;    ///< what each degree of freedom counts, >= 0 (dofs)
};

/// The same of two motions that are all there is of their styles, of one hierarchy and one frame rate.
/// Throws InvalidArgument if one has no frame, SkeletonMismatch if the hierarchies differ. Cost O(frames x joints).
TimingPair timing_features(const Motion& input, const Motion& output, const FeatureShares& shares = {});

/// The same of several motions, each all there is of its style.
struct TimingGroup {
  std::vector<FrameMatrix> clips;  ///< of every motion (frames x dofs)
  Eigen::VectorXd weights;         ///< what each degree of freedom counts, >= 0 (dofs)
};

/// The same of any number of motions, for align_group (groupwise.h): a degree of freedom counts if it changes in all of
/// them. `legs`: of all; none leaves the feet out. Columns: the degrees of freedom of alignment_features, their
/// movement, the two feet. Throws InvalidArgument if there is no motion or one has no frame, SkeletonMismatch if the
/// hierarchies differ. Cost O(frames x joints).
TimingGroup timing_features(const std::vector<Motion>& motions, const std::optional<motion::Legs>& legs,
                            const FeatureShares& shares = {});

}  // namespace strut::representation
