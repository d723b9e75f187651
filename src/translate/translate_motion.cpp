// SPDX-License-Identifier: MIT
// represent -> (warm up) -> model step -> strength -> re-time -> invert the representation.
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/motion/resample.h>
#include <strut/representation/extrapolation.h>
#include <strut/representation/representation.h>
#include <strut/representation/retime.h>
#include <strut/translate/signal_translator.h>
#include <strut/translate/strength.h>
#include <strut/translate/translate_motion.h>

namespace strut {
namespace {

void check(const StyleModel& model, const Motion& clip, const TranslateOptions& options) {
  representation::check_skeleton(model.input(), clip.skeleton());
  if (clip.num_frames() < 2) throw InvalidArgument("clip", "at least two frames", std::to_string(clip.num_frames()));
  if (!(options.strength >= 0.0 && options.strength <= 1.5)) {
    throw InvalidArgument("strength", "a number from 0 to 1.5", std::to_string(options.strength));
  }
  if (!(options.warm_up >= 0.0 && options.warm_up <= 60.0)) {
    throw InvalidArgument("warm_up", "0 to 60 seconds", std::to_string(options.warm_up));
  }
}

FrameMatrix translate_signal(const std::shared_ptr<const StyleModel>& model, const FrameMatrix& input,
                             const TranslateOptions& options) {
  translate::SignalTranslator translator(model);
  Eigen::RowVectorXd output(model->num_dofs() + 1);
  const auto warm_up_frames = static_cast<int>(std::lround(options.warm_up * model->frame_rate()));
  const FrameMatrix before = representation::extrapolate_back(input, warm_up_frames);
  for (Eigen::Index t = 0; t < before.rows(); ++t) translator.step(before.row(t), output);
  FrameMatrix translated(input.rows(), output.size());
  for (Eigen::Index t = 0; t < input.rows(); ++t) {
    translator.step(input.row(t), output);
    translate::apply_strength(*model, input.row(t), options.strength, output);
    translated.row(t) = output;
  }
  return translated;
}

}  // namespace

Motion translate_motion(const std::shared_ptr<const StyleModel>& model, const Motion& clip,
                        const TranslateOptions& options, Diagnostics* diagnostics) {
  if (!model) throw InvalidArgument("model", "a style model", "null");
  check(*model, clip, options);
  if (diagnostics != nullptr && clip.frame_rate() != model->frame_rate()) {
    diagnostics->note("translate", "the clip is resampled to the model's frame rate and back");
  }
  const Motion source = motion::resample(clip, model->frame_rate());
  if (source.num_frames() < 2) throw InvalidArgument("clip", "at least two frames at the model's rate", "fewer");
  const FrameMatrix translated = translate_signal(model, representation::encode(model->input(), source), options);
  const Eigen::Index dofs = model->num_dofs();
  const FrameMatrix pose_rows = translated.leftCols(dofs);
  const FrameMatrix rows = options.retime ? representation::retime(pose_rows, translated.col(dofs)) : pose_rows;
  const auto start = representation::placement(representation::pelvis_world(source.skeleton(), source.frame(0)),
                                               model->input().upright());
  const Motion result = representation::decode(model->output(), rows, model->frame_rate(), start,
                                               clip.shared_skeleton(), source.frame(0));
  return motion::resample(result, clip.frame_rate());
}

}  // namespace strut
