// SPDX-License-Identifier: MIT
// What learning found, between LearnReport, the JSON kept in a model, and words for a person.
#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include <strut/learn/learn_style.h>

namespace strut::cli {

nlohmann::ordered_json report_as_json(const LearnReport& report);

/// The report that report_as_json gave, or nothing if the JSON is something else.
std::optional<LearnReport> report_from_json(const nlohmann::ordered_json& json);

/// On standard output.
void print_report(const LearnReport& report, const StyleModel& model);

}  // namespace strut::cli
