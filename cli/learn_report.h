// SPDX-License-Identifier: MIT
// What learning found, between LearnReport, the JSON kept in a model, and words for a person.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include <strut/learn/learn_report.h>
#include <strut/model/style_model.h>

namespace strut::cli {

nlohmann::ordered_json report_as_json(const LearnReport& report);

/// The report that report_as_json gave, now or before there were radial maps, or nothing if the JSON is something else.
std::optional<LearnReport> report_from_json(const nlohmann::ordered_json& json);

/// What kind of model it is and how large: `a radial map of 150 centres, ...`.
std::string model_in_words(const StyleModel& model);

/// In plain words on standard output: what the examples cover, how well every part of the body is predicted, which
/// parts poorly, and which another take would help.
void print_report(const LearnReport& report, const StyleModel& model);

}  // namespace strut::cli
