// SPDX-License-Identifier: MIT
// warm up -> push frame by frame -> re-time -> hold the feet.
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/representation/representation.h>
#include <strut/representation/retime.h>
#include <strut/translate/translate_motion.h>
#include <strut/translate/translator.h>

namespace strut {
namespace {

/// A clip as the translator gave it, and how long each of its frames lasts.
struct TranslatedFrames {
  std::vector<Pose> frames;
  Eigen::VectorXd log_time_warp;
};

TranslatedFrames translate_frames(Translator& translator, const Motion& clip, double warm_up) {
  const auto lead = std::lround(warm_up * clip.frame_rate());
  if (lead > 0) {
    const auto opening = std::min<std::ptrdiff_t>(clip.num_frames(), lead + 1);
    translator.warm_up({clip.frames().begin(), clip.frames().begin() + opening}, static_cast<int>(lead));
  }
  TranslatedFrames translation{clip.frames(), Eigen::VectorXd(clip.num_frames())};
  Eigen::Index t = 0;
  for (Pose& frame : translation.frames) {
    translator.push(view(frame), view(frame));
    translation.log_time_warp[t++] = std::log(translator.time_warp());
  }
  return translation;
}

/// The translated frames, each lasting as long as the style makes it.
Motion retimed(const representation::Representation& style, const Motion& translated, const Eigen::VectorXd& warp) {
  const Pose& first = translated.frame(0);
  const auto start =
      representation::placement(representation::pelvis_world(translated.skeleton(), first), style.upright());
  const FrameMatrix rows = representation::retime(representation::encode(style, translated), warp);
  return representation::decode(style, rows, translated.frame_rate(), start, translated.shared_skeleton(), first);
}

/// With the whole clip at hand footplants are detected in it, rather than told from the model's states: they are then
/// where the result has them after re-timing.
Motion cleaned(const Motion& result, const postprocess::FootskateOptions& options, Diagnostics* diagnostics) {
  const auto legs = motion::find_legs(result);
  if (!legs) return result;
  const auto plants = postprocess::detect_footplants(result, *legs);
  return postprocess::clean_footskate(result, *legs, plants, options, diagnostics);
}

/// For every frame of a clip the moment of its output, both at `clip_rate`, from those of the model's frames at
/// `model_rate`.
Eigen::VectorXd moments_at_rate(const Eigen::VectorXd& moments, double model_rate, int num_frames, double clip_rate,
                                int num_output_frames) {
  const double model_frames = model_rate / clip_rate;
  Eigen::VectorXd result(num_frames);
  for (int frame = 0; frame < num_frames; ++frame) {
    const double at = std::min(frame * model_frames, static_cast<double>(moments.size() - 1));
    const auto before = std::min(static_cast<Eigen::Index>(at), moments.size() - 2);
    const double share = at - static_cast<double>(before);
    const double moment = (1.0 - share) * moments[before] + share * moments[before + 1];
    result[frame] = std::min(moment / model_frames, num_output_frames - 1.0);
  }
  return result;
}

void check(const Motion& clip, const StyleModel& model, const TranslateOptions& options) {
  if (!(options.warm_up >= 0.0 && options.warm_up <= kLongestWarmUp)) {
    throw InvalidArgument("warm_up", "0 to 60 seconds", std::to_string(options.warm_up));
  }
  representation::check_skeleton(model.input(), clip.skeleton());
  if (clip.num_frames() < 2) throw InvalidArgument("clip", "at least two frames", std::to_string(clip.num_frames()));
}

}  // namespace

Translation translate_with_moments(const std::vector<std::shared_ptr<const StyleModel>>& models, const Motion& clip,
                                   const TranslateOptions& options, Diagnostics* diagnostics) {
  Translator translator(models, {.controls = options.controls, .generalization = options.generalization});
  const StyleModel& model = translator.model();
  check(clip, model, options);
  if (diagnostics != nullptr && clip.frame_rate() != model.frame_rate()) {
    diagnostics->note("translate", "the clip is resampled to the model's frame rate and back");
  }
  const Motion source = motion::resample(clip, model.frame_rate());
  if (source.num_frames() < 2) throw InvalidArgument("clip", "at least two frames at the model's rate", "fewer");
  TranslatedFrames translation = translate_frames(translator, source, options.warm_up);
  if (!options.retime) translation.log_time_warp.setZero();
  const Motion translated(clip.shared_skeleton(), model.frame_rate(), std::move(translation.frames));
  const Motion result = options.retime ? retimed(model.output(), translated, translation.log_time_warp) : translated;
  Motion at_own_rate = motion::resample(result, clip.frame_rate());
  const Eigen::VectorXd moments =
      moments_at_rate(representation::retimed_moments(translation.log_time_warp), model.frame_rate(), clip.num_frames(),
                      clip.frame_rate(), at_own_rate.num_frames());
  if (!options.clean_feet) return {std::move(at_own_rate), moments};
  return {cleaned(at_own_rate, options.footskate, diagnostics), moments};
}

Motion translate_motion(const std::vector<std::shared_ptr<const StyleModel>>& models, const Motion& clip,
                        const TranslateOptions& options, Diagnostics* diagnostics) {
  return translate_with_moments(models, clip, options, diagnostics).motion;
}

Motion translate_motion(const std::shared_ptr<const StyleModel>& model, const Motion& clip,
                        const TranslateOptions& options, Diagnostics* diagnostics) {
  return translate_motion(std::vector{model}, clip, options, diagnostics);
}

}  // namespace strut
