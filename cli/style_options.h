// SPDX-License-Identifier: MIT
// What a person says about the style to be put on: the model or models, how much of them, where on the body, and what
// becomes of motion that no example shows.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <strut/model/style_model.h>
#include <strut/postprocess/generalization.h>
#include <strut/translate/controls.h>

namespace strut::cli {

// Between these lie the confidence and the preference of generalization.
inline constexpr double kLeastGeneralization = 0.1, kMostGeneralization = 1000.0;

/// Another model, and its share of the output, 0 to 1.
struct BlendedModel {
  std::string path;
  double share = 0.0;
};

struct StyleArguments {
  std::string model;
  std::vector<BlendedModel> others;
  TranslatorControls controls;
  postprocess::GeneralizationOptions generalization;

  /// Every model's path, the first one's first.
  [[nodiscard]] std::vector<std::string> paths() const;
};

/// Adds the model and all options above. `arguments` must live as long as the command.
void add_style_options(CLI::App& command, StyleArguments& arguments);

/// What a blend's first model and the others weigh: the first one has what their shares leave. Throws InvalidArgument
/// if a share is not from 0 to 1, or all are more than 1 together.
std::vector<double> blend_weights(const std::vector<double>& shares);

/// Throws SkeletonMismatch or BadInput, naming two of `paths` (one per model), if the models cannot be blended.
void check_blend(const std::vector<std::string>& paths, const std::vector<std::shared_ptr<const StyleModel>>& models);

/// Reads the models. Throws what read_style_model and check_blend throw.
std::vector<std::shared_ptr<const StyleModel>> read_models(const StyleArguments& arguments);

}  // namespace strut::cli
