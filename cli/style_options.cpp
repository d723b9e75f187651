// SPDX-License-Identifier: MIT
#include "style_options.h"

#include "input_files.h"
#include "usage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/model/style_model_io.h>

namespace strut::cli {
namespace {

/// `NAME=NUMBER`, split at the last '='. The number is NaN where there is none.
struct NamedNumber {
  std::string name;
  double number = std::nan("");
};

NamedNumber parse_named_number(const std::string& word) {
  NamedNumber result;
  const auto equals = word.rfind('=');
  result.name = word.substr(0, equals);
  std::string digits = equals == word.npos ? "" : word.substr(equals + 1);
  double number = 0.0;
  if (!digits.empty() && CLI::detail::lexical_cast(digits, number)) result.number = number;
  return result;
}

std::string part_names() {
  std::string names;
  for (const char* name : motion::kBodyPartNames) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

void set_part(const std::string& word, TranslatorControls& controls) {
  const auto [name, strength] = parse_named_number(word);
  const auto* const part = std::find(motion::kBodyPartNames.begin(), motion::kBodyPartNames.end(), name);
  if (part == motion::kBodyPartNames.end()) {
    throw CLI::ValidationError("--part", "expected NAME=X, NAME one of " + part_names() + ", got '" + word + "'");
  }
  if (!(strength >= 0.0 && strength <= kMostStrength)) {
    throw CLI::ValidationError("--part", "expected " + name + "= and a number from 0 to 1.5, got '" + word + "'");
  }
  controls.parts.at(static_cast<std::size_t>(part - motion::kBodyPartNames.begin())) = strength;
}

void set_blend(const std::vector<std::string>& words, StyleArguments& arguments) {
  std::vector<double> shares;
  arguments.others.clear();
  for (const std::string& word : words) {
    const auto [path, share] = parse_named_number(word);
    if (path.empty() || !(share >= 0.0 && share <= 1.0)) {
      throw CLI::ValidationError("--blend", "expected MODEL.strut=SHARE, SHARE from 0 to 1, got '" + word + "'");
    }
    arguments.others.push_back({path, share});
    shares.push_back(share);
  }
  try {
    arguments.controls.weights = blend_weights(shares);
  } catch (const InvalidArgument& error) {
    throw CLI::ValidationError("--" + std::string(error.what()));
  }
}

void add_strengths(CLI::App& command, TranslatorControls& controls) {
  const auto add = [&](const char* name, double& value, const char* description) {
    command.add_option(name, value, description)->check(number_in(0.0, kMostStrength))->capture_default_str();
  };
  add("--strength", controls.strength, "How much of the style: 0 none, 1 all, up to 1.5");
  add("--pose", controls.pose, "How much of the way the style holds the body, times the strength");
  add("--movement", controls.movement,
      "How much of the way the style moves, speed and timing included, times the strength");
  command
      .add_option_function<std::vector<std::string>>(
          "--part",
          [&controls](const std::vector<std::string>& words) {
            for (const std::string& word : words) set_part(word, controls);
          },
          "How much of it on a part of the body (" + part_names() + "), times the strength; repeatable")
      ->allow_extra_args(false)
      ->type_name("NAME=X");
}

void add_generalization(CLI::App& command, postprocess::GeneralizationOptions& options) {
  command.add_flag_callback(
      "--no-generalization", [&options] { options.enabled = false; },
      "Translate motion unlike every example too, instead of passing it through");
  command
      .add_option("--confidence", options.confidence,
                  "How unlike the examples motion may be and still be translated, in deviations")
      ->check(number_in(kLeastGeneralization, kMostGeneralization))
      ->capture_default_str();
  command
      .add_option("--preference", options.preference,
                  "How strongly doubtful motion is translated rather than passed through")
      ->check(number_in(kLeastGeneralization, kMostGeneralization))
      ->capture_default_str();
}

}  // namespace

std::vector<std::string> StyleArguments::paths() const {
  std::vector<std::string> all{model};
  for (const BlendedModel& other : others) all.push_back(other.path);
  return all;
}

void add_style_options(CLI::App& command, StyleArguments& arguments) {
  command.add_option("model", arguments.model, "Style model made by strut learn (.strut)")->required();
  command
      .add_option_function<std::vector<std::string>>(
          "--blend", [&arguments](const std::vector<std::string>& words) { set_blend(words, arguments); },
          "Another model and its share of the output, 0 to 1; MODEL has the rest; repeatable")
      ->allow_extra_args(false)
      ->type_name("FILE=SHARE");
  add_strengths(command, arguments.controls);
  add_generalization(command, arguments.generalization);
}

std::vector<double> blend_weights(const std::vector<double>& shares) {
  std::vector<double> weights{1.0};
  for (const double share : shares) {
    if (!(share >= 0.0 && share <= 1.0))
      throw InvalidArgument("blend", "shares from 0 to 1", fmt::format("{:g}", share));
    weights.push_back(share);
    weights.front() -= share;
  }
  constexpr double kRounding = 1e-9;  // shares such as 0.1 sum up to nearly 1
  if (weights.front() < -kRounding) {
    throw InvalidArgument("blend", "shares of at most 1 together", fmt::format("{:g}", 1.0 - weights.front()));
  }
  weights.front() = std::max(0.0, weights.front());
  return weights;
}

void check_blend(const std::vector<std::string>& paths, const std::vector<std::shared_ptr<const StyleModel>>& models) {
  for (std::size_t i = 1; i < models.size(); ++i) {
    const StyleModel &first = *models.front(), &model = *models[i];
    check_same_skeleton(paths[i], model.skeleton(), paths.front(), first.skeleton());
    if (model.frame_rate() == first.frame_rate()) continue;
    throw BadInput(paths[i],
                   fmt::format("runs at {:g} frames per second, {} at {:g}", model.frame_rate(), paths.front(),
                               first.frame_rate()),
                   "learn both at one rate: strut learn --frame-rate");
  }
}

std::vector<std::shared_ptr<const StyleModel>> read_models(const StyleArguments& arguments) {
  const std::vector<std::string> paths = arguments.paths();
  std::vector<std::shared_ptr<const StyleModel>> models;
  for (const std::string& path : paths) models.push_back(read_style_model(path));
  check_blend(paths, models);
  return models;
}

}  // namespace strut::cli
