// SPDX-License-Identifier: MIT
#include "learn/examples.h"

#include <algorithm>
#include <cmath>

#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/representation/alignment_features.h>
#include <strut/representation/extrapolation.h>

namespace strut::learn {
namespace {

std::vector<Motion> resampled(const std::vector<Motion>& clips, double frame_rate) {
  std::vector<Motion> result;
  for (const Motion& clip : clips) result.push_back(motion::resample(clip, frame_rate));
  return result;
}

/// `range` of `clip` in the frames of the same clip `resampled`.
FrameRange rescaled(const FrameRange& range, const Motion& clip, const Motion& resampled) {
  const double ratio = resampled.frame_rate() / clip.frame_rate();
  const int begin = static_cast<int>(std::lround(range.begin * ratio));
  const int end = static_cast<int>(std::lround(range.end * ratio));
  return {std::min(begin, resampled.num_frames()), std::min(end, resampled.num_frames())};
}

StyleSignals represent(const std::vector<Motion>& clips, const Eigen::Quaterniond& upright) {
  StyleSignals style{representation::fit_representation(clips, upright), {}, {}};
  for (const Motion& clip : clips) style.clips.push_back(representation::encode(style.representation, clip));
  for (const Motion& clip : clips) {
    const auto legs = motion::find_legs(clip);
    if (legs) style.stillness.push_back(representation::foot_stillness(clip, *legs));
  }
  if (style.stillness.size() < clips.size()) style.stillness.clear();
  return style;
}

}  // namespace

Examples represent_examples(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs,
                            const std::vector<ClipPair>& pairs, double frame_rate) {
  const std::vector<Motion> input_clips = resampled(inputs, frame_rate);
  const std::vector<Motion> output_clips = resampled(outputs, frame_rate);
  const Eigen::Quaterniond upright = motion::upright_reference(input_clips);
  Examples examples{frame_rate, represent(input_clips, upright), represent(output_clips, upright), pairs};
  for (ClipPair& pair : examples.pairs) {
    const auto i = static_cast<std::size_t>(pair.input_clip);
    const auto o = static_cast<std::size_t>(pair.output_clip);
    pair.input_frames = rescaled(pair.input_frames, inputs[i], input_clips[i]);
    pair.output_frames = rescaled(pair.output_frames, outputs[o], output_clips[o]);
  }
  return examples;
}

FrameMatrix with_lead_in(const FrameMatrix& clip, const FrameRange& frames, int lead_in) {
  const int real = std::min(frames.begin, lead_in);
  const int count = real + frames.num_frames();
  FrameMatrix rows(lead_in - real + count, clip.cols());
  rows.topRows(lead_in - real) = representation::extrapolate_back(clip, lead_in - real);
  rows.bottomRows(count) = clip.middleRows(frames.begin - real, count);
  return rows;
}

}  // namespace strut::learn
