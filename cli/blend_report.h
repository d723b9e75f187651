// SPDX-License-Identifier: MIT
// What strut blend tells of a gait model: its styles, their speeds, and how well left-out cells were predicted.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <strut/blend/gait_model.h>
#include <strut/blend/learn_gaits.h>

namespace strut::cli {

/// A report as the model's provenance keeps it: errors in degrees.
nlohmann::ordered_json gait_report_as_json(const blend::GaitReport& report, const std::vector<std::string>& styles);

/// What a model holds, with its provenance.
nlohmann::ordered_json gait_model_as_json(const std::string& path, const blend::GaitModel& model);

/// Prints what a model holds and, as far as its provenance tells, how well it predicts what was left out.
void print_gait_model(const std::string& path, const blend::GaitModel& model);

}  // namespace strut::cli
