// SPDX-License-Identifier: MIT
// Options about BVH files that several commands have, and the words a person uses for units and axes.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <strut/io/bvh.h>

namespace strut::cli {

/// "m", "cm", "mm", "in" or "ft" to the unit. Throws CLI::ValidationError that names `option`.
LengthUnit parse_unit(const std::string& option, const std::string& word);

/// "y" or "z" to the axis. Throws CLI::ValidationError that names `option`.
UpAxis parse_up(const std::string& option, const std::string& word);

/// Adds the options that say how input files are to be read: PREFIXunit, PREFIXup and --positions. `options` must live
/// as long as the command.
void add_bvh_read_options(CLI::App& command, const std::string& prefix, BvhReadOptions& options);

/// The same options as a person writes them, with the prefix "--" and each after a blank; none for what is as usual.
std::string words_of(const BvhReadOptions& options);

}  // namespace strut::cli
