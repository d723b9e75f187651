// SPDX-License-Identifier: MIT
// Every command of the program. cmd_<name>.cpp defines add_<name>: it declares the command's options on `app` and sets
// the callback that parses nothing more, calls the library and prints. Errors are thrown and turned into messages and
// exit codes by main.cpp alone.
#pragma once

#include <CLI/CLI.hpp>

namespace strut::cli {

void add_pair(CLI::App& app);
void add_learn(CLI::App& app);
void add_translate(CLI::App& app);
void add_clean(CLI::App& app);
void add_align(CLI::App& app);
void add_info(CLI::App& app);
void add_convert(CLI::App& app);
void add_measure(CLI::App& app);
void add_footplants(CLI::App& app);
void add_sysid(CLI::App& app);
void add_blend(CLI::App& app);
void add_effort(CLI::App& app);
void add_view(CLI::App& app);
void add_report(CLI::App& app);
void add_demo(CLI::App& app);
void add_completion(CLI::App& app);

}  // namespace strut::cli
