// SPDX-License-Identifier: MIT
// A frame in, a frame out (Hsu et al. 2005, 4.4): the live half of style translation. The time warp is left out here,
// because applying it would break the synchrony with the performer; translate_motion.h applies it.
#pragma once

#include <memory>

#include <strut/representation/representation.h>
#include <strut/translate/signal_translator.h>

namespace strut {

/// Translates a stream of poses. One per character; the model may be shared by any number of threads.
class Translator {
 public:
  /// `strength`: 0 gives the input, 1 the style, up to 1.5 more than the style.
  /// Throws InvalidArgument if `model` is null or `strength` is outside [0, 1.5].
  explicit Translator(std::shared_ptr<const StyleModel> model, double strength = 1.0);

  /// Translates the next frame; the frames are model().frame_rate() apart. The first output stands where the first
  /// input stands; bones are the input's. Zero latency; allocates nothing once `output` has its size.
  /// Throws InvalidArgument, before anything changes, if `input` has another number of joints, a non-finite number or a
  /// rotation that is not of unit length.
  void push(const Pose& input, Pose& output);

  /// How long the latest frame lasts in the output style [frames], for callers that re-time by themselves.
  [[nodiscard]] double time_warp() const;

  /// Forgets everything pushed.
  void reset();

  [[nodiscard]] const StyleModel& model() const noexcept { return step_.model(); }

 private:
  void start();

  translate::SignalTranslator step_;
  double strength_;
  representation::Encoder encoder_;
  representation::Decoder decoder_;
  bool started_ = false;
  Eigen::RowVectorXd input_row_, output_row_;
};

}  // namespace strut
