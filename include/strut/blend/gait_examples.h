// SPDX-License-Identifier: MIT
// Examples of gaits: from clips of several styles to closed cycles, each with its measured speed, all on one phase. The
// cycles of a style that have nearly the same speed become one cell, their mean.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <strut/blend/gait_loop.h>
#include <strut/core/diagnostics.h>
#include <strut/motion/motion.h>
#include <strut/representation/representation.h>

namespace strut::blend {

/// A clip and the style it shows.
struct StyledClip {
  std::string style;
  Motion motion;
  std::string name;  ///< what reports call it, e.g. its file; may be empty
};

/// How cycles are cut and aligned.
struct GaitExampleOptions {
  int harmonics = 12;         ///< of the gait cycle kept in the closed cycles, 1 to 30
  double most_turning = 0.5;  ///< cycles that turn more are left out [rad]; what less turning there is is taken out
  double speed_bin = 0.12;    ///< cycles of a style whose speeds differ by less than this share make one cell, (0, 1]
  int rounds = 3;             ///< of aligning to the mean of all cycles, 1 to 20
};

/// The mean of the cycles of one style at one speed.
struct GaitCell {
  int style = 0;       ///< index into GaitExamples::styles
  double speed = 0.0;  ///< mean of the cycles' [m/s]
  int num_cycles = 0;
  GaitLoop loop;
};

/// What examples amount to.
struct GaitExamples {
  std::shared_ptr<const representation::Representation> representation;  ///< one for all styles
  double frame_rate = 0.0;                                               ///< of the first clip [frames/s]
  std::vector<std::string> styles;                                       ///< in order of appearance
  std::vector<GaitCell> cells;                                           ///< by style, then speed
};

/// Cuts every clip into gait cycles of the left foot (motion/gait_cycles.h; speeds are measured there), aligns each to
/// a common cycle and closes it. Cycles slower than 0.05 m/s are left out.
///
/// Alignment: the cycle of medium speed is the first reference; iterative motion warping (Hsu et al. 2005, section 3)
/// gives each cycle's correspondence, which is taken over into a smooth periodic warp of three harmonics and refined by
/// Gauss-Newton steps, the cycles of a style to their mean, the styles to the mean of all; then the means are taken
/// anew, and so on. The distance between end
/// and beginning of a cycle is spread over it, and what is left is a Fourier series.
///
/// Clips of which no cycle is used are reported as warnings. Throws InvalidArgument if there is no clip, a clip's body
/// has no legs, a style has no cycle in all its clips, a style's name is empty, or an option is out of range;
/// SkeletonMismatch if the skeletons differ. Cost: some milliseconds a cycle.
GaitExamples gait_examples(const std::vector<StyledClip>& clips, const GaitExampleOptions& options = {},
                           Diagnostics* diagnostics = nullptr);

}  // namespace strut::blend
