// SPDX-License-Identifier: MIT
// A frame in, a frame out (Hsu et al. 2005, 4.4): the live half of style translation. The time warp is left out here,
// because applying it would break the synchrony with the performer; translate_motion.h applies it.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <strut/motion/pose_view.h>
#include <strut/postprocess/footskate.h>
#include <strut/postprocess/generalization.h>
#include <strut/translate/controls.h>

namespace strut {

class StyleModel;

namespace translate {
template <typename Scalar>
class Stream;
}

/// What is fixed for a translator's life.
struct TranslatorOptions {
  TranslatorControls controls{};                        ///< what the controls are at first
  postprocess::GeneralizationOptions generalization{};  ///< of input that is unlike the examples
  bool clean_feet =
      false;  ///< hold planted feet (postprocess/footskate.h), told from the models' states; costs latency
  postprocess::FootskateOptions footskate{};  ///< how, if so
  double glide = 0.08;  ///< reach of the smoothing of controls that are moved [s], 0 or more: most of it is done in
                        ///< four times that
};

/// Translates a stream of poses, in Scalar (float or double). One per character. It shares the models with any number
/// of others, in any threads; its own calls must not overlap. Copies have the same state: a copy is a snapshot.
template <typename Scalar>
class BasicTranslator {
 public:
  /// One model, or several that are blended (TranslatorControls::weights): of one hierarchy and frame rate.
  /// Throws InvalidArgument if there is no model, one is null, their rates differ, or an option is out of range, or if
  /// feet are to be cleaned and a model has no footplants or its body no legs; SkeletonMismatch if their hierarchies
  /// differ.
  explicit BasicTranslator(std::shared_ptr<const StyleModel> model, const TranslatorOptions& options = {});
  explicit BasicTranslator(std::vector<std::shared_ptr<const StyleModel>> models,
                           const TranslatorOptions& options = {});
  BasicTranslator(const BasicTranslator& other);
  BasicTranslator(BasicTranslator&&) noexcept;
  BasicTranslator& operator=(BasicTranslator other) noexcept;
  ~BasicTranslator();

  /// Translates the next frame; the frames are model().frame_rate() apart. The first output stands where the first
  /// input stands; bones are the input's. No lock, no allocation. `output` may be `input`.
  /// Where the body jumps (faster than 25 m/s or 60 rad/s) the output goes with it and moves on as it moved.
  /// Gives whether a frame was written: the one of latency() pushes ago, so none at the first latency() pushes.
  /// Throws InvalidArgument, before anything changes, if either has another number of joints, or `input` a number that
  /// is not finite, a translation of 10,000 km or a rotation that is not of unit length (within 1e-3).
  /// Cost: docs/performance.md.
  bool push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output);

  /// The same for poses, converted where Scalar is float; allocates only if `output` has another size.
  bool push(const Pose& input, Pose& output);

  /// How many frames the output lags behind: constant, 0 unless feet are cleaned (FootskateOptions::look_ahead).
  [[nodiscard]] int latency() const noexcept;

  /// After the last push: writes the next of the latency() frames that are still to come; false when there are no more.
  /// A push afterwards begins a new stream for the feet. Throws InvalidArgument if `output` has another number of
  /// joints.
  bool flush(const PoseView<Scalar>& output);
  bool flush(Pose& output);

  /// Runs the model over what may have come before a stream that is about to begin with `opening`, in time backwards
  /// from it (representation/extrapolation.h), so that the first frames are usable. `opening`: the first frames, two or
  /// more, which are pushed afterwards as usual; `frames`: how many are made up. To be called before the first push;
  /// allocates. Throws InvalidArgument as push does, or if something was pushed already.
  void warm_up(const std::vector<Pose>& opening, int frames);

  /// Moves the controls: they glide there over the next frames; before the first frame they are there at once.
  /// No allocation if `controls.weights` is empty. Throws InvalidArgument if one is out of range (check_controls).
  void set_controls(const TranslatorControls& controls);
  [[nodiscard]] const TranslatorControls& controls() const noexcept;

  /// How long the latest frame lasts in the output style [frames], 1/20 to 20, for callers that re-time by themselves.
  [[nodiscard]] double time_warp() const;

  /// How much of the input was blended into the latest frame because it is unlike the examples, 0 to 1.
  [[nodiscard]] double input_share() const;

  /// Forgets everything pushed; controls arrive where they were going.
  void reset();

  /// Takes over the state of `snapshot`, a copy made earlier of this translator or of one made alike. No allocation.
  /// Throws InvalidArgument if it has other models or another latency.
  void restore(const BasicTranslator& snapshot);

  /// The state alone, as bytes that mean something to translators of the same models and options on this machine:
  /// everything that pushed frames and moved controls leave behind. To keep many characters apart in little memory.
  /// Throws InvalidArgument where feet are cleaned: that keeps whole poses; copy the translator instead.
  [[nodiscard]] std::size_t state_size() const;
  /// Writes state_size() bytes. No allocation.
  void save_state(std::byte* bytes) const;
  /// Takes over what `save_state` wrote; controls() still says what it said. No allocation.
  void load_state(const std::byte* bytes);

  [[nodiscard]] const StyleModel& model(int index = 0) const;
  [[nodiscard]] int num_models() const noexcept;

 private:
  std::unique_ptr<translate::Stream<Scalar>> stream_;
};

using Translator = BasicTranslator<double>;
using FloatTranslator = BasicTranslator<float>;

extern template class BasicTranslator<float>;
extern template class BasicTranslator<double>;

}  // namespace strut
