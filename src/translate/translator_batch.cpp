// SPDX-License-Identifier: MIT
#include "translate/check_pose.h"

#include <string>

#include <strut/core/error.h>
#include <strut/model/style_model.h>
#include <strut/translate/translator_batch.h>

namespace strut {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The pose of one character among those of all.
template <typename Scalar>
PoseView<Scalar> pose_of(const PoseView<Scalar>& all, int character) {
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(character) * all.num_joints;
  return {all.rotations + 4 * first, all.translations + 3 * first, all.num_joints};
}

}  // namespace

template <typename Scalar>
TranslatorBatch<Scalar>::TranslatorBatch(std::shared_ptr<const StyleModel> model, int num_characters,
                                         const TranslatorOptions& options)
    : TranslatorBatch(std::vector{std::move(model)}, num_characters, options) {}

template <typename Scalar>
TranslatorBatch<Scalar>::TranslatorBatch(std::vector<std::shared_ptr<const StyleModel>> models, int num_characters,
                                         const TranslatorOptions& options)
    : translator_(std::move(models), options), num_characters_(num_characters), state_size_(translator_.state_size()) {
  if (num_characters < 1) throw InvalidArgument("num_characters", "at least 1", std::to_string(num_characters));
  states_.resize(state_size_ * at(num_characters));
  for (int character = 0; character < num_characters; ++character) translator_.save_state(state(character));
}

template <typename Scalar>
void TranslatorBatch<Scalar>::push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output) {
  const int joints = model().skeleton().num_joints();
  translate::check_num_joints("output", output.num_joints, joints);
  for (int character = 0; character < num_characters_; ++character) {
    translate::check_pose(pose_of(input, character), joints, character);
  }
  for (int character = 0; character < num_characters_; ++character) {
    translator_.load_state(state(character));
    translator_.push(pose_of(input, character), pose_of(output, character));
    translator_.save_state(state(character));
  }
}

template <typename Scalar>
void TranslatorBatch<Scalar>::set_controls(int character, const TranslatorControls& controls) {
  translator_.load_state(state(character));
  translator_.set_controls(controls);
  translator_.save_state(state(character));
}

template <typename Scalar>
void TranslatorBatch<Scalar>::reset(int character) {
  translator_.load_state(state(character));
  translator_.reset();
  translator_.save_state(state(character));
}

template <typename Scalar>
std::byte* TranslatorBatch<Scalar>::state(int character) {
  if (character < 0 || character >= num_characters_) {
    throw InvalidArgument("character", "0 to " + std::to_string(num_characters_ - 1), std::to_string(character));
  }
  return states_.data() + state_size_ * at(character);
}

template class TranslatorBatch<float>;
template class TranslatorBatch<double>;

}  // namespace strut
