// SPDX-License-Identifier: MIT
// A correspondence as a curve: a smooth, strictly rising map from one signal's time to another's, with its slope and
// its inverse. What blending needs, where a correspondence tells only of whole frames.
#pragma once

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/math/smooth_curve.h>

namespace strut::align {

/// From input frames to output frames, both with fractions and counted at the frames' middles (frame 2 is 2.0). Between
/// frames the curve is a monotone cubic with a continuous slope (math::SmoothCurve); it covers exactly as much of the
/// output over each whole input frame as the correspondence says. Beyond the clips it goes on along its end slopes.
class WarpCurve {
 public:
  /// Smooth the differential warp first (smooth_differential_warp) if it comes in steps: the curve follows it. Throws
  /// InvalidArgument if it is empty, not finite or not positive. Cost O(frames).
  explicit WarpCurve(const Correspondence& correspondence);

  /// The output frame that belongs to an input frame. Cost O(log frames), as all below.
  [[nodiscard]] double output_frame(double input_frame) const;
  /// The input frame that belongs to an output frame: output_frame's inverse.
  [[nodiscard]] double input_frame(double output_frame) const;
  /// Output frames per input frame, > 0.
  [[nodiscard]] double slope(double input_frame) const;

 private:
  math::SmoothCurve passed_;  // output frames passed after a number of input frames
};

/// The correspondence the other way round: of every output frame, in the input. Throws InvalidArgument as WarpCurve
/// does, or if the ends are open: what lies outside belongs to nothing. Cost O(frames log frames).
Correspondence inverse(const Correspondence& correspondence);

/// From `a`'s input by way of `b`'s to `b`'s output: the correspondence of a's input with b's output, where a's output
/// is b's input. Throws InvalidArgument if their frames differ in number. Cost O(frames log frames).
Correspondence compose(const Correspondence& a, const Correspondence& b);

}  // namespace strut::align
