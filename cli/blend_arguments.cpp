// SPDX-License-Identifier: MIT
#include "blend_arguments.h"

#include "csv_table.h"
#include "input_files.h"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <strut/core/error.h>

namespace strut::cli {
namespace {

constexpr double kRounding = 1e-6;  // weights such as 0.1 sum up to nearly 1
constexpr const char* kTime = "time_s";
constexpr const char* kSpeed = "speed_m_per_s";
constexpr const char* kTurnRate = "turn_rate_rad_per_s";

std::string names_of(const blend::GaitModel& model) {
  std::string names;
  for (const blend::GaitStyle& style : model.styles()) names += (names.empty() ? "" : ", ") + style.name;
  return names;
}

/// The columns of the table that are styles. Refuses a column that is nothing.
std::vector<int> style_columns(const std::string& path, const blend::GaitModel& model) {
  std::vector<int> styles;
  for (const std::string& name : read_csv_names(path)) {
    if (name == kTime || name == kSpeed || name == kTurnRate || name.empty()) continue;
    const int style = model.find_style(name);
    if (style < 0) {
      throw ParseError(path, 1, 0, fmt::format("{}, {}, {} or a style's name", kTime, kSpeed, kTurnRate),
                       "'" + name + "'", "the styles of the model are: " + names_of(model));
    }
    styles.push_back(style);
  }
  if (styles.empty()) {
    throw ParseError(path, 1, 0, "a column for every style that is wanted", "none",
                     "the styles of the model are: " + names_of(model));
  }
  return styles;
}

blend::GaitKey key_of(const std::string& path, const CsvRow& row, const std::vector<int>& styles, bool turns,
                      const blend::GaitModel& model) {
  const auto refuse = [&](std::size_t column, const char* expected, double found) {
    throw ParseError(path, row.line, row.number_columns[column], expected, fmt::format("{:g}", found));
  };
  if (!(row.numbers[1] > 0.0)) refuse(1, "a speed above 0", row.numbers[1]);
  const std::size_t first = turns ? 3 : 2;
  blend::GaitControls controls{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.styles().size())), row.numbers[1],
                               turns ? row.numbers[2] : 0.0};
  for (std::size_t k = 0; k < styles.size(); ++k) controls.weights[styles[k]] = row.numbers[first + k];
  if (std::abs(controls.weights.sum() - 1.0) > kRounding) {
    refuse(first, "weights of the styles that sum to 1", controls.weights.sum());
  }
  return {row.numbers[0], std::move(controls)};
}

}  // namespace

std::vector<StyleClips> parse_style_clips(const std::vector<std::string>& words) {
  std::vector<StyleClips> all;
  const auto style_at = [&](const std::string& name) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const StyleClips& s) { return s.style == name; });
    if (found == all.end()) return all.insert(all.end(), {name, {}});
    std::rotate(found, found + 1, all.end());  // the style named last is at the end
    return all.end() - 1;
  };
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    if (equals == 0 || (equals == std::string::npos && all.empty())) {
      throw CLI::ValidationError("--learn", "expected STYLE= and the files of that style, got '" + word + "'");
    }
    if (equals == std::string::npos) {
      all.back().paths.push_back(word);
    } else {
      const auto style = style_at(word.substr(0, equals));
      if (equals + 1 < word.size()) style->paths.push_back(word.substr(equals + 1));
    }
  }
  for (const StyleClips& style : all) {
    if (style.paths.empty()) throw CLI::ValidationError("--learn", "style '" + style.style + "' has no file");
  }
  return all;
}

Eigen::VectorXd parse_style_weights(const std::vector<std::string>& words, const blend::GaitModel& model,
                                    const std::string& model_path) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.styles().size()));
  std::vector<int> seen;
  for (const std::string& word : words) {
    const auto equals = word.rfind('=');
    const std::string name = word.substr(0, equals);
    double weight = words.size() == 1 ? 1.0 : std::nan("");
    if (equals != std::string::npos && !CLI::detail::lexical_cast(word.substr(equals + 1), weight))
      weight = std::nan("");
    if (!std::isfinite(weight)) {
      throw CLI::ValidationError("--style", "expected STYLE=WEIGHT, WEIGHT a number, got '" + word + "'");
    }
    const int style = model.find_style(name);
    if (style < 0) {
      throw BadInput(model_path, "has no style '" + name + "'", "its styles are: " + names_of(model));
    }
    if (std::find(seen.begin(), seen.end(), style) != seen.end()) {
      throw CLI::ValidationError("--style", "'" + name + "' is there twice");
    }
    seen.push_back(style);
    weights[style] = weight;
  }
  if (std::abs(weights.sum() - 1.0) > kRounding) {
    throw CLI::ValidationError("--style", fmt::format("expected weights that sum to 1, got {:g}", weights.sum()));
  }
  return weights;
}

std::vector<blend::GaitKey> read_gait_keys(const std::string& path, const blend::GaitModel& model) {
  const std::vector<int> styles = style_columns(path, model);
  const std::vector<std::string> header = read_csv_names(path);
  const bool turns = std::find(header.begin(), header.end(), kTurnRate) != header.end();
  std::vector<std::string> columns{kTime, kSpeed};
  if (turns) columns.emplace_back(kTurnRate);
  for (const int style : styles) columns.push_back(model.styles()[static_cast<std::size_t>(style)].name);
  std::vector<blend::GaitKey> keys;
  for (const CsvRow& row : read_csv_rows(path, {}, columns)) {
    if (!keys.empty() && row.numbers[0] <= keys.back().time) {
      throw ParseError(path, row.line, row.number_columns[0], fmt::format("a time after {:g} s", keys.back().time),
                       fmt::format("{:g}", row.numbers[0]));
    }
    keys.push_back(key_of(path, row, styles, turns, model));
  }
  return keys;
}

}  // namespace strut::cli
