// SPDX-License-Identifier: MIT
// What cross-validation found, as tables for people: every method beside its baselines.
#pragma once

#include <string>
#include <vector>

#include <strut/effort/effort_validation.h>

namespace strut::cli {

/// A table per split: errors per factor, their mean, what the 90 % intervals covered, the best baseline named; for
/// actions left out a line per group as well. `group_names`: what to call groups; empty: by their numbers. Lines end
/// with newlines.
std::string validation_report(const std::vector<effort::ValidationResult>& results,
                              const std::vector<std::string>& group_names = {});

}  // namespace strut::cli
