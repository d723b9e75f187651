// SPDX-License-Identifier: MIT
// What strut info and strut effort learn tell of an effort model.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <strut/effort/effort_model.h>

namespace strut::cli {

/// Prints what the model holds, group by group.
void print_effort_model(const std::string& path, const effort::EffortModel& model);

/// The same for programs.
nlohmann::ordered_json effort_model_as_json(const std::string& path, const effort::EffortModel& model);

}  // namespace strut::cli
