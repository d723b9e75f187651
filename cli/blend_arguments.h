// SPDX-License-Identifier: MIT
// What a person says to strut blend in words: which clips show which style, how much of which style is wanted, and
// tables of keys.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <strut/blend/gait_model.h>
#include <strut/blend/locomotion.h>

namespace strut::cli {

/// A style's clips in the order given.
struct StyleClips {
  std::string style;
  std::vector<std::string> paths;
};

/// `STYLE=FILE`, or `STYLE=` and after it, as words of their own, the files of that style (so that a shell's patterns
/// may name them). Throws CLI::ValidationError if a file comes before any style, or a style has none.
std::vector<StyleClips> parse_style_clips(const std::vector<std::string>& words);

/// `STYLE=WEIGHT` words as weights of the model's styles; a single `STYLE` alone weighs 1. Throws CLI::ValidationError
/// if a word is not of that form, a style comes twice or weights do not sum to 1, and Error, naming the styles there
/// are, for one that the model lacks.
Eigen::VectorXd parse_style_weights(const std::vector<std::string>& words, const blend::GaitModel& model,
                                    const std::string& model_path);

/// Keys from a table: columns time_s, speed_m_per_s and one per style of `styles`, turn_rate_rad_per_s if there is one.
/// Styles without a column weigh nothing. Throws ParseError with line and column for what cannot be read, times that do
/// not ascend, speeds that are not positive and weights that do not sum to 1.
std::vector<blend::GaitKey> read_gait_keys(const std::string& path, const blend::GaitModel& model);

}  // namespace strut::cli
