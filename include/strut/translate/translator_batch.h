// SPDX-License-Identifier: MIT
// Many characters in one style: translators of one model (or blend of models) stepped together, frame by frame. Only
// what differs between characters is kept for each, so that thousands of them stay near the processor.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <strut/translate/translator.h>

namespace strut {

/// As many BasicTranslators, to the bit, in a fraction of their memory and time. One thread at a time; split characters
/// over several batches to use several.
template <typename Scalar>
class TranslatorBatch {
 public:
  /// `num_characters` at least 1. Throws what BasicTranslator throws.
  TranslatorBatch(std::shared_ptr<const StyleModel> model, int num_characters, const TranslatorOptions& options = {});
  TranslatorBatch(std::vector<std::shared_ptr<const StyleModel>> models, int num_characters,
                  const TranslatorOptions& options = {});

  /// The next frame of every character. `input` and `output`: the characters' poses one after the other in one pair of
  /// arrays (rotations num_characters x num_joints x 4, translations num_characters x num_joints x 3); `num_joints` of
  /// the views is that of one character. They may be the same. No allocation. Throws InvalidArgument, before anything
  /// changes, as BasicTranslator::push does, naming the character.
  void push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output);

  /// Controls of one character, from 0. Throws InvalidArgument if it does not exist or as
  /// BasicTranslator::set_controls.
  void set_controls(int character, const TranslatorControls& controls);

  /// Forgets the frames of one character, which may then be another. Throws InvalidArgument if it does not exist.
  void reset(int character);

  [[nodiscard]] int num_characters() const noexcept { return num_characters_; }
  /// Memory that one more character takes.
  [[nodiscard]] std::size_t bytes_per_character() const noexcept { return state_size_; }
  [[nodiscard]] const StyleModel& model() const { return translator_.model(); }

 private:
  [[nodiscard]] std::byte* state(int character);

  BasicTranslator<Scalar> translator_;  // works on one character after the other
  int num_characters_;
  std::size_t state_size_;
  std::vector<std::byte> states_;
};

extern template class TranslatorBatch<float>;
extern template class TranslatorBatch<double>;

}  // namespace strut
