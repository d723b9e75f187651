// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/translate/strength.h>
#include <strut/translate/translator.h>

namespace strut {
namespace {

void check_pose(const Pose& pose, int num_joints) {
  const auto expected = static_cast<std::size_t>(num_joints);
  if (pose.rotations.size() != expected || pose.translations.size() != expected) {
    throw InvalidArgument("input", std::to_string(expected) + " joints", std::to_string(pose.rotations.size()));
  }
  for (std::size_t j = 0; j < expected; ++j) {
    constexpr double kUnitLengthTolerance = 1e-3;  // single-precision callers round to 1e-7; a wrong order is far off
    const bool is_unit = std::abs(pose.rotations[j].squaredNorm() - 1.0) < kUnitLengthTolerance;  // false for NaN
    if (!is_unit || !pose.translations[j].allFinite()) {
      throw InvalidArgument("input", "finite numbers and unit rotations", "neither at joint " + std::to_string(j));
    }
  }
}

}  // namespace

Translator::Translator(std::shared_ptr<const StyleModel> model, double strength)
    : step_(std::move(model)),
      strength_(strength),
      encoder_(step_.model().input(), step_.model().frame_rate()),
      decoder_(step_.model().output(), step_.model().frame_rate(), {}),
      input_row_(step_.model().num_dofs()),
      output_row_(step_.model().num_dofs() + 1) {
  if (!(strength >= 0.0 && strength <= 1.5)) {
    throw InvalidArgument("strength", "a number from 0 to 1.5", std::to_string(strength));
  }
}

void Translator::push(const Pose& input, Pose& output) {
  check_pose(input, model().skeleton().num_joints());
  encoder_.encode(input, input_row_);
  if (!started_) start();
  step_.step(input_row_, output_row_);
  translate::apply_strength(model(), input_row_, strength_, output_row_);
  decoder_.decode(output_row_.head(model().num_dofs()), input, output);
}

/// The first frame has no velocity: standing still would be a jolt to a model of walking, so it moves as the examples
/// do on average.
void Translator::start() {
  input_row_.head<representation::kHeight>() =
      model().input_scaling().mean().head<representation::kHeight>().transpose();
  decoder_ = {model().output(), model().frame_rate(), encoder_.placement()};
  started_ = true;
}

double Translator::time_warp() const {
  return std::exp(output_row_[model().time_warp_dof()]);
}

void Translator::reset() {
  step_.reset();
  encoder_ = {model().input(), model().frame_rate()};
  started_ = false;
}

}  // namespace strut
