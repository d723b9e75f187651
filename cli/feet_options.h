// SPDX-License-Identifier: MIT
// The option that says which joints are the feet, for every command that looks at them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <strut/io/bvh.h>
#include <strut/motion/legs.h>
#include <strut/motion/motion.h>

namespace strut::cli {

/// What a person said of the feet.
struct FeetOptions {
  std::string left, right;  ///< names of ankles or toes; empty: found by shape
};

/// Adds --feet LEFT,RIGHT. `feet` must live as long as the command.
void add_feet_option(CLI::App& command, FeetOptions& feet);

/// The legs of the body in the clip at `path`: those with the feet named, else those found. Throws BadInput, naming the
/// file, if there are none such.
motion::Legs legs_of(const std::string& path, const Motion& clip, const FeetOptions& feet);

/// Whether legs can stretch in a file of this layout: only where knees and ankles have position channels.
bool holds_stretch(const BvhLayout& layout, const motion::Legs& legs);

}  // namespace strut::cli
