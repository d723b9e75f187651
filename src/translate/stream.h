// SPDX-License-Identifier: MIT
// What a translator does with every frame: encode it, step the models, mix input and output as the controls say, blend
// the models, decode, hold the feet.
#pragma once

#include "translate/feet.h"
#include "translate/glide.h"
#include "translate/style_mix.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <strut/model/model_step.h>
#include <strut/representation/pose_encoder.h>
#include <strut/translate/translator.h>

namespace strut::translate {

/// What one model makes of the frames.
template <typename Scalar>
struct Branch {
  Branch(const std::shared_ptr<const StyleModel>& model, double fade)
      : step(model),
        encoder(model->input(), model->frame_rate()),
        mix(*model),
        input(static_cast<std::size_t>(step.layout().num_slots())),
        output(input.size()),
        share({0.0}, fade * model->frame_rate()) {}

  /// The model step, and how familiar it was.
  void run(const postprocess::GeneralizationOptions& options) {
    step.step(input.data(), output.data());
    share.go_to(std::array{postprocess::input_share(static_cast<double>(step.largest_deviation()), options)});
  }
  /// This frame's velocities are not to be known from it. Standing still would be a jolt to a model of walking, so the
  /// body moves as it did, or, if that is not known either, as the examples do on average.
  void guess_velocities() {
    const auto& mean = step.model().input_scaling().mean();
    for (int dof = 0; dof < representation::kHeight; ++dof) {
      input[static_cast<std::size_t>(dof)] =
          has_velocities ? velocities[static_cast<std::size_t>(dof)] : static_cast<Scalar>(mean[dof]);
    }
  }
  void keep_velocities() {
    std::copy_n(input.begin(), representation::kHeight, velocities.begin());
    has_velocities = true;
  }

  template <typename Visit>
  void visit_state(Visit&& visit) {
    step.visit_state(visit);
    encoder.visit_state(visit);
    share.visit_state(visit);
    visit(&has_velocities, 1);
    visit(velocities.data(), velocities.size());
  }

  ModelStep<Scalar> step;
  representation::PoseEncoder<Scalar> encoder;
  StyleMix<Scalar> mix;
  math::AlignedVector<Scalar> input, output;
  Glide share;
  bool has_velocities = false;
  std::array<Scalar, representation::kHeight> velocities{};  // of the latest frame
};

/// The frames of one character. Copies have the same state.
template <typename Scalar>
class Stream {
 public:
  /// Throws as BasicTranslator's constructor.
  Stream(std::vector<std::shared_ptr<const StyleModel>> given, const TranslatorOptions& wanted);

  /// As BasicTranslator::push, the poses checked already.
  bool push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output);
  void warm_up(const Motion& opening, int frames);
  void set_controls(const TranslatorControls& controls);
  void reset();
  /// To be called when the state has been replaced.
  void weigh_joints();

  [[nodiscard]] double weight(std::size_t branch) const { return weights_.value()[branch]; }
  [[nodiscard]] double log_time_warp() const;
  [[nodiscard]] double input_share() const;
  [[nodiscard]] const std::vector<std::shared_ptr<const StyleModel>>& models() const noexcept { return models_; }
  [[nodiscard]] const TranslatorOptions& options() const noexcept { return options_; }
  [[nodiscard]] std::optional<Feet>& feet() noexcept { return feet_; }
  [[nodiscard]] bool has_started() const noexcept { return started_; }
  /// Memory for a pose in Scalar.
  [[nodiscard]] PoseView<Scalar> converted() {
    return {pose_rotations_.data(), pose_translations_.data(), models_.front()->skeleton().num_joints()};
  }

  /// Calls `visit(first, count)` for every array of plain numbers that frames and controls leave behind.
  template <typename Visit>
  void visit_state(Visit&& visit) {
    for (Branch<Scalar>& branch : branches_) branch.visit_state(visit);
    strengths_.visit_state(visit);
    weights_.visit_state(visit);
    decoder_.visit_state(visit);
    visit(&started_, 1);
  }

 private:
  void translate(const PoseView<const Scalar>& input, const PoseView<Scalar>& output);
  void tell_feet();
  void encode(const PoseView<const Scalar>& input);
  void begin();
  void glide();
  void blend();

  std::vector<std::shared_ptr<const StyleModel>> models_;
  TranslatorOptions options_;
  std::vector<int> parts_;  // per joint below the pelvis
  std::vector<Branch<Scalar>> branches_;
  Glide strengths_;
  std::vector<double> shares_;  // of the models: where they go, and
  Glide weights_;               // where they are
  MixWeights<Scalar> mix_weights_;
  representation::PoseDecoder<Scalar> decoder_;
  std::optional<Feet> feet_;
  bool started_ = false;
  std::array<Scalar, representation::RowLayout::kRotations> root_{};
  math::AlignedVector<Scalar> rotations_;                           // blended, planes
  math::AlignedVector<Scalar> pose_rotations_, pose_translations_;  // a pose, converted
};

}  // namespace strut::translate
