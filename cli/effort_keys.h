// SPDX-License-Identifier: MIT
// What a person says of the Effort that is wanted: sliders that stay, or a table of keys over time; and what counts.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <strut/effort/effort_curve.h>

namespace strut::cli {

/// --flow, --weight, --time and --keys.
struct EffortSliders {
  std::optional<double> flow, weight, time;  ///< in [-1, 1]
  std::string keys;                          ///< table instead of them
};

/// Adds the options. `sliders` must live as long as the command.
void add_effort_sliders(CLI::App& command, EffortSliders& sliders);

/// What they say. Throws CLI::ValidationError if nothing was asked for, and as read_effort_keys.
effort::EffortCurve effort_wanted(const EffortSliders& sliders);

/// Keys from a table: the columns time_s and one or more of flow, weight and time. Throws FileError, or ParseError with
/// line and column for what cannot be read, times that do not ascend and values outside [-1, 1].
effort::EffortCurve read_effort_keys(const std::string& path);

/// "equal", "noticed", or three numbers FLOW,WEIGHT,TIME of at least 0, not all 0. Throws CLI::ValidationError.
effort::EffortVector parse_effort_weights(const std::string& word);

}  // namespace strut::cli
