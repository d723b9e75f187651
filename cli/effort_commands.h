// SPDX-License-Identifier: MIT
// The commands below `strut effort`. effort_<name>.cpp defines add_effort_<name>, as cmd_<name>.cpp does for the
// program's own commands (commands.h).
#pragma once

#include <CLI/CLI.hpp>

namespace strut::cli {

void add_effort_segment(CLI::App& app);
void add_effort_match(CLI::App& app);
void add_effort_labels(CLI::App& app);
void add_effort_estimate(CLI::App& app);

void add_effort_apply(CLI::App& effort);
void add_effort_blend(CLI::App& effort);
void add_effort_learn(CLI::App& effort);

}  // namespace strut::cli
