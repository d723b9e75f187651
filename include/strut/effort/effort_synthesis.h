// SPDX-License-Identifier: MIT
// Puts an Effort on a motion (Torresani, Hackney, Bregler 2006): the motion is cut into snippets like labelled
// fragments, each snippet is replaced by the blend of two of those that shows what is wanted, and what was replaced is
// joined with what was kept.
#pragma once

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/effort/blend_choice.h>
#include <strut/effort/effort_curve.h>
#include <strut/effort/inertialization.h>
#include <strut/effort/motion_segmentation.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>
#include <strut/postprocess/footskate.h>

namespace strut::effort {

/// How an Effort is put on a motion.
struct ApplyOptions {
  ChoiceOptions choice;          ///< its weights are of the factors that are asked for
  double unasked_weight = 0.25;  ///< a factor not asked for shall stay as the snippet shows it; what an error in it
                                 ///< counts against one that is asked for, >= 0
  double join_weight = 0.1;      ///< what a join counts when candidates are chosen: this times, in squares of the
                                 ///< model's threshold, its distance in posture and what velocities come apart by in
                                 ///< 0.1 s is added to the squared error, >= 0
  double jerk_weight = 1.0;      ///< what a blend counts whose joints accelerate near its ends by more than 1.5 times
                                 ///< the 99th percentile of the fragments: this times the squared excess, >= 0
  JoinOptions join;              ///< how long a join is felt
  double boundary_frames = 3.0;  ///< SegmentationOptions::boundary_frames
  double shortest_gap = 0.3;     ///< shorter unmatched stretches are left to the snippets beside them [s], >= 0
  bool clean_feet = true;        ///< hold planted feet
  postprocess::FootskateOptions footskate{};
};

/// A stretch of the motion and what became of it.
struct AppliedSnippet {
  motion::FrameRange input;   ///< frames of the motion
  motion::FrameRange output;  ///< frames of the result
  int group = kNoMatch;       ///< content; kNoMatch: kept as it was, and nothing below has a meaning
  int fragment = kNoMatch;    ///< that it is most like
  double match_cost = 0.0;    ///< mean distance to that [m]
  ChosenBlend blend;          ///< what it was replaced by
  EffortVector wanted = EffortVector::Constant(
      kNotRated);  ///< of the factors asked for; of the others what the snippet showed, if that is known
  EffortVector before = EffortVector::Constant(kNotRated);  ///< what the snippet shows, by how it moves
  EffortVector after = EffortVector::Constant(kNotRated);   ///< what stands in the result shows, by how it moves
};

/// A motion with an Effort on it.
struct AppliedEffort {
  Motion motion;                          ///< on the input's skeleton, at its frame rate
  std::vector<AppliedSnippet> snippets;   ///< in order, covering all frames of both motions
  double coverage = 0.0;                  ///< share of the input's frames that were replaced, 0 ... 1
  std::vector<motion::Footplant> plants;  ///< of the result (0 left, 1 right); none for a body without legs
};

/// Puts `wanted`, over the motion's time, on `motion`. Each snippet gets what is wanted at its middle. The first frame
/// stays where it is; from there on the travel of what was put in counts, turned into the way the body faces, and
/// scaled to its legs. The blends are those of BlendChooser::candidates that together, over the whole motion, cost
/// least by error and joins (dynamic programming). At a join, either piece may lose up to 0.1 s, at most a quarter of
/// itself, and what is kept may go on for so long, where posture and velocity fit better then. A motion of which
/// nothing matches comes back as it is, coverage 0. The same input gives the same result. Warns where less than half is
/// covered. Throws SkeletonMismatch if the hierarchy is not the model's, and InvalidArgument if the motion has fewer
/// than 4 frames, an option is out of range, or no fragment of a group is labelled in a factor asked for. Cost: a
/// search of every fragment, and BlendChooser::choose per snippet.
AppliedEffort apply_effort(const BlendChooser& chooser, const Motion& motion, const EffortCurve& wanted,
                           const ApplyOptions& options = {}, Diagnostics* diagnostics = nullptr);

}  // namespace strut::effort
