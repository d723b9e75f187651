// SPDX-License-Identifier: MIT
// represent -> (warm up) -> model step -> strength -> re-time -> invert the representation.
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/motion/resample.h>
#include <strut/representation/representation.h>
#include <strut/translate/retime.h>
#include <strut/translate/signal_translator.h>
#include <strut/translate/strength.h>
#include <strut/translate/translate_motion.h>

namespace strut {
namespace {

using representation::kHeight;

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

/// What may have come before the clip: its beginning, reflected through its first frame, so that position and velocity
/// are continuous there. Velocities among the degrees of freedom are even in time, all others odd.
Eigen::RowVectorXd extrapolated_back(const FrameMatrix& rows, Eigen::Index frames_before) {
  const Eigen::Index mirrored = std::min(frames_before, rows.rows() - 1);
  Eigen::RowVectorXd row = 2.0 * rows.row(0) - rows.row(mirrored);
  row.head<kHeight>() = rows.row(mirrored).head<kHeight>();
  return row;
}

FrameMatrix translate_signal(const std::shared_ptr<const StyleModel>& model, const FrameMatrix& input,
                             const TranslateOptions& options) {
  translate::SignalTranslator translator(model);
  Eigen::RowVectorXd output(model->num_dofs() + 1);
  for (auto k = static_cast<Eigen::Index>(std::lround(options.warm_up * model->frame_rate())); k > 0; --k) {
    translator.step(extrapolated_back(input, k), output);
  }
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
  const FrameMatrix rows = options.retime ? translate::retime(pose_rows, translated.col(dofs)) : pose_rows;
  const auto start = representation::placement(representation::pelvis_world(source.skeleton(), source.frame(0)),
                                               model->input().upright());
  const Motion result = representation::decode(model->output(), rows, model->frame_rate(), start,
                                               clip.shared_skeleton(), source.frame(0));
  return motion::resample(result, clip.frame_rate());
}

}  // namespace strut
