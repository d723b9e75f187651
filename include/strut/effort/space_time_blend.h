// SPDX-License-Identifier: MIT
// Space-time interpolation of two fragments of like content: a motion between them, or beyond one of them, in posture,
// timing, travel and contacts (Torresani, Hackney, Bregler 2006; design after Kovar and Gleicher 2003).
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// How two fragments are blended.
struct SpaceTimeBlendOptions {
  double slope_limit = 2.0;       ///< s > 1: the alignment's slopes stay inside 1/s ... s
  double largest_angle = 2.0944;  ///< joints farther apart than this somewhere cannot be blended [rad], (0, pi)
};

/// A blended motion.
struct Blend {
  Motion motion;                          ///< on the first fragment's skeleton, at its frame rate
  std::vector<motion::Footplant> plants;  ///< contacts of both, blended, in its frames (0 left, 1 right)
};

/// Two fragments, aligned once and blended as often as wanted. Immutable; const calls are thread-safe.
class SpaceTimeBlend {
 public:
  /// Aligns. Throws SkeletonMismatch if the hierarchies differ, InvalidArgument if the rates differ, a fragment has
  /// fewer than 4 frames, one is more than slope_limit times as long as the other, or a joint is farther apart than
  /// largest_angle (which joint, where). Cost: an alignment.
  SpaceTimeBlend(const Motion& first, const Motion& second, const SpaceTimeBlendOptions& options = {});
  ~SpaceTimeBlend();
  SpaceTimeBlend(SpaceTimeBlend&&) noexcept;
  SpaceTimeBlend& operator=(SpaceTimeBlend&&) noexcept;

  /// alpha = 0: the first fragment, 1: the second, to rounding; outside [0, 1] exaggerates. Time is always strictly
  /// increasing: linear in alpha inside (-1/(s-1), s/(s-1)), geometric rates outside. Starts where and heading as
  /// the first fragment does. Throws InvalidArgument if alpha is not within [-2, 3]. Cost O(frames x joints).
  [[nodiscard]] Blend at(double alpha) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace strut::effort
