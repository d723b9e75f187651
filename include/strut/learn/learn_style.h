// SPDX-License-Identifier: MIT
// Learns a style from paired clips: reads as the upper row of Figure 3 in Hsu et al. 2005.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <strut/align/continuous_warp.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/core/diagnostics.h>
#include <strut/learn/clip_pair.h>
#include <strut/learn/learn_report.h>
#include <strut/model/style_model.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>
#include <strut/representation/alignment_features.h>
#include <strut/sysid/identify.h>

namespace strut {

/// What kind of model is learnt.
enum class LearnMethod {
  kRadial,  ///< a radial map of the whole body's context, with each joint's own detail on it
  kLinear,  ///< a linear system per joint: a regularized one that sees the context, or the subspace method's on the
            ///< joint's own inputs, whichever predicts left-out clips better
  kPaper,   ///< as in the paper: N4SID per joint on its own inputs, order by the largest gap of the singular values
};

/// How the moments of a pair are found that belong together.
enum class AlignmentMethod {
  kContinuous,  ///< align::continuous_warp, by posture, movement and stillness of the feet
  kIterative,   ///< as in the paper: align::iterative_motion_warping, by posture; LearnMethod::kPaper always does
};

/// How a radial map is fitted.
struct RadialOptions {
  int centres = 400;   ///< at most; a quarter of the examples' frames if that is fewer
  double width = 2.0;  ///< of the basis functions, in distances of an example to its nearest centre, above 0
  double ridge = 0.1;  ///< shrinkage of the weights, above 0 (sysid::fit_weights)
  int lags = 3;        ///< contexts seen at once, 1 or more
  double lag = 0.1;    ///< time from one to the next [s]
};

struct LearnOptions {
  LearnMethod method = LearnMethod::kRadial;
  int context = 16;  ///< principal components of the whole body's input that every part sees; 0 for none, which leaves
                     ///< linear systems only
  RadialOptions radial{};
  AlignmentMethod alignment_method = AlignmentMethod::kContinuous;
  /// Of kContinuous; its slope_limit and weights are each pair's own. Stiffer than align's default: what is learnt is
  /// what the takes have in common.
  align::ContinuousWarpOptions warp{.slope_reach = 0.006, .space_reach = 1.0};
  representation::FeatureShares features{};          ///< what kContinuous looks at
  align::IterativeMotionWarpingOptions alignment{};  ///< of kIterative; its slope_limit is each pair's own
  std::optional<double> time_warp_smoothing{};       ///< reach of the smoothing of the differential warp [s]; chosen on
                                                     ///< left-out pairs if empty
  double lead_in = 1.0;                              ///< input before each pair that the model runs over first [s]
  double longest_memory = 0.3;                       ///< slowest decay a block's states may have, to 1/e [s]
  /// Of every block; its max_radius follows from longest_memory.
  sysid::IdentifyOptions identification{.max_order = 8, .ridge = 0.003};
  double frame_rate = 0.0;  ///< [frames/s] clips are resampled to; 0: the first input clip's
  /// Of every output clip, at its own frames, foot 0 left and 1 right: what the footplant classifier is trained on.
  /// Empty: as postprocess::detect_footplants finds them.
  std::vector<std::vector<motion::Footplant>> footplants{};
};

struct LearntStyle {
  std::shared_ptr<const StyleModel> model;
  LearnReport report;
};

/// Called as learning proceeds, from one thread at a time: what is being done, how many of how many are done.
using Progress = std::function<void(const std::string& step, int done, int total)>;

/// What to keep in the model about where it came from, as JSON, given what was learnt.
using DescribeProvenance = std::function<std::string(const LearnReport&)>;

/// Learns the translation from the clips `inputs` to the clips `outputs` by the pairs between them.
/// All clips have one hierarchy.
/// Throws InvalidArgument if there is no pair, a pair names a clip or frames that do not exist, no pair can be aligned,
/// or nothing moves in them, or if footplants are not of these clips; SkeletonMismatch if hierarchies differ. Reports
/// pairs that are left out (shorter than learn::kShortestStretch, not to be aligned, along their slope limit) and what
/// the examples do not cover. The result does not depend on the number of threads.
LearntStyle learn_style(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs,
                        const std::vector<learn::ClipPair>& pairs, const LearnOptions& options = {},
                        const DescribeProvenance& provenance = {}, Diagnostics* diagnostics = nullptr,
                        const Progress& progress = {});

}  // namespace strut
