// SPDX-License-Identifier: MIT
// Space-time interpolation of two fragments of like content: a motion between them, or beyond one of them, in posture,
// timing, travel and contacts (Torresani, Hackney, Bregler 2006; design after Kovar and Gleicher 2003).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <strut/motion/annotation.h>
#include <strut/motion/legs.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// How two fragments are blended.
struct SpaceTimeBlendOptions {
  double slope_limit = 2.0;       ///< s > 1: the alignment's slopes stay inside 1/s ... s
  double largest_angle = 2.0944;  ///< joints farther apart than this somewhere cannot be blended [rad], (0, pi)
};

/// A blended motion.
struct Blend {
  Motion motion;  ///< on the first fragment's skeleton, at its frame rate
  std::vector<motion::Footplant>
      plants;  ///< contacts of both, blended, in its frames (0 left, 1 right), by foot, begin
  Eigen::VectorXd first_frames, second_frames;  ///< the fragments' moments that each frame blends, rising [frames]
};

/// Two fragments, aligned once and blended as often as wanted. Immutable; const calls are thread-safe.
class SpaceTimeBlend {
 public:
  /// Aligns (align::refine_warp of representation::timing_features, both ways round and the mean of both taken, so
  /// that neither fragment sets the time). Throws SkeletonMismatch if the hierarchies differ, InvalidArgument if the
  /// rates differ, a fragment has fewer than 4 frames, one lasts more than slope_limit times as long as the other, a
  /// joint is turned farther from the other's than largest_angle (which joint, where), a body leans more than 150
  /// degrees (it has no heading there), or an option is out of range. Cost: two alignments, a few milliseconds.
  SpaceTimeBlend(const Motion& first, const Motion& second, const SpaceTimeBlendOptions& options = {});
  ~SpaceTimeBlend();
  SpaceTimeBlend(SpaceTimeBlend&&) noexcept;
  SpaceTimeBlend& operator=(SpaceTimeBlend&&) noexcept;

  /// alpha = 0: the first fragment, 1: the second, to rounding; outside [0, 1] exaggerates. Starts where and heading as
  /// the first fragment does.
  ///
  /// Time always rises strictly. It is linear in alpha, (1 - alpha) p + alpha q, inside (-1/(s-1), s/(s-1)) with s the
  /// slope limit, and at most as far out as no rate falls below a tenth of the nearer fragment's. Beyond that every
  /// moment's rate changes by the factor q'/p' per unit of alpha from what it is at the limit: geometric, continuous.
  /// The last frame is the fragments' last; time is stretched by at most half a frame for it to be a whole one.
  ///
  /// Joints: q_i exp(alpha log(q_i^-1 q_j)). Root: steps over the ground and turns in the heading frame, per moment of
  /// the common time rather than per second, so that feet that stand in both stand in the blend; height and tilt.
  /// The second fragment is scaled to the first's leg length if its bones differ.
  ///
  /// Plants of one foot that overlap most in the common time are blended; one without a counterpart stays while its
  /// fragment is the nearer one. Throws InvalidArgument if alpha is not within [-2, 3]. Cost O(frames x joints).
  [[nodiscard]] Blend at(double alpha) const;

  /// From where to where time is linear in alpha.
  [[nodiscard]] double least_linear_alpha() const noexcept;
  [[nodiscard]] double greatest_linear_alpha() const noexcept;
  /// The body's legs, whose plants `at` returns; none for a body without.
  [[nodiscard]] const std::optional<motion::Legs>& legs() const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace strut::effort
