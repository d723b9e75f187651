// SPDX-License-Identifier: MIT
// Checks of what a person types after the program's name, and what to tell them when it cannot be understood: in our
// words, with the option's name, instead of CLI11's.
#pragma once

#include <map>
#include <string>

#include <CLI/CLI.hpp>

namespace strut::cli {

/// A check for CLI11: a number from `least` to `greatest`, and no NaN.
CLI::Validator number_in(double least, double greatest);

/// A check for CLI11: a number that is not negative, and no NaN or infinity.
CLI::Validator not_negative();

/// For CLI11: one of a few words, turned into the number it stands for.
CLI::Validator one_of(const std::map<std::string, int>& numbers);

/// Prints on standard error one line about arguments that CLI11 refused, and a hint. `app` is the whole program.
void print_usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace strut::cli
