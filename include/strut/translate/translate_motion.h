// SPDX-License-Identifier: MIT
// Translates a whole clip, re-timed (Hsu et al. 2005, Figure 3, lower row): the translator of translator.h, frame by
// frame, and what needs the whole clip.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/core/diagnostics.h>
#include <strut/model/style_model.h>
#include <strut/motion/motion.h>
#include <strut/postprocess/footskate.h>
#include <strut/postprocess/generalization.h>
#include <strut/translate/controls.h>

namespace strut {

inline constexpr double kLongestWarmUp = 60.0;  ///< [s]

struct TranslateOptions {
  TranslatorControls controls{};
  postprocess::GeneralizationOptions generalization{};
  bool retime = true;      ///< apply the style's timing; false keeps the input's
  bool clean_feet = true;  ///< hold the planted feet of the result (postprocess/footskate.h), which are detected in it
  postprocess::FootskateOptions footskate{};  ///< how, if so
  /// Run the model over this much backward extrapolation first [s], 0 to kLongestWarmUp; 0 starts from x0 = 0.
  double warm_up = 0.3;
};

/// The clip in the output style of `models` (one, or several that are blended), at the clip's own frame rate, starting
/// where the clip starts, with the clip's bones (legs may stretch, FootskateOptions::max_stretch). A clip of another
/// frame rate is resampled for the model and back. Throws SkeletonMismatch, naming joints, if the hierarchy is not the
/// model's; InvalidArgument if the clip has fewer than two frames or an option is out of range. Cost O(frames x
/// joints).
Motion translate_motion(const std::vector<std::shared_ptr<const StyleModel>>& models, const Motion& clip,
                        const TranslateOptions& options = {}, Diagnostics* diagnostics = nullptr);

/// A translated clip, and when in it happens what is done in the input.
struct Translation {
  Motion motion;
  Eigen::VectorXd moments;  ///< per frame of the input the moment of the output, never falling [frames of the output]
};

/// translate_motion, with the moments: those of the re-timing, or every frame's own where there is none. So input and
/// output can be shown in phase.
Translation translate_with_moments(const std::vector<std::shared_ptr<const StyleModel>>& models, const Motion& clip,
                                   const TranslateOptions& options = {}, Diagnostics* diagnostics = nullptr);

/// translate_motion with one model.
Motion translate_motion(const std::shared_ptr<const StyleModel>& model, const Motion& clip,
                        const TranslateOptions& options = {}, Diagnostics* diagnostics = nullptr);

}  // namespace strut
