// SPDX-License-Identifier: MIT
// What strut effort apply tells of its result: a table for a person, a table or JSON for a program.
#pragma once

#include <string>

#include <strut/effort/effort_synthesis.h>

namespace strut::cli {

/// Prints how much was replaced, and per snippet by which blend, and what was wanted, predicted and is seen in it.
void print_applied(const std::string& output, const effort::AppliedEffort& applied, double frame_rate,
                   const effort::EffortModel& model);

/// The same of every snippet as CSV, a line each; JSON if `path` ends in .json.
std::string format_applied(const std::string& path, const effort::AppliedEffort& applied, double frame_rate,
                           const effort::EffortModel& model);

}  // namespace strut::cli
