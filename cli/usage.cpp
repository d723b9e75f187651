// SPDX-License-Identifier: MIT
#include "usage.h"

#include "terminal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/core.h>

namespace strut::cli {
namespace {

/// Further apart, two words are hardly a misspelling of each other.
constexpr std::size_t kLargestMisspelling = 2;

std::string expected_number(const std::string& range, const std::string& word) {
  return fmt::format("expected a number {}, got '{}'", range, word);
}

/// Letters to insert, take out or replace (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = i;
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// What may stand where `word` stands: commands, or the options of one.
std::vector<std::string> words_of(const CLI::App& command, bool options) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      if (options) words.push_back("--" + name);
    }
  }
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!options) words.push_back(sub->get_name());
  }
  return words;
}

std::string nearest(const std::string& word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t least = kLargestMisspelling + 1;
  for (const std::string& candidate : words) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least) best = candidate;
    least = std::min(least, distance);
  }
  return best;
}

struct UsageError {
  std::string message, hint;
};

UsageError not_understood(const CLI::App& command, std::vector<std::string> words) {
  // The value of a misspelt option is left over too; the option is what to name.
  std::stable_partition(words.begin(), words.end(), [](const std::string& word) { return word[0] == '-'; });
  const std::string word = words.front().substr(0, words.front().find('='));
  const bool is_option = word[0] == '-';
  const bool has_commands = !words_of(command, false).empty();
  const std::string kind = is_option ? "option" : has_commands ? "command" : "argument";
  const std::string meant = nearest(word, words_of(command, is_option));
  return {kind == "argument" ? fmt::format("one argument too many: '{}'", word)
                             : fmt::format("there is no {} '{}'", kind, word),
          meant.empty() ? "" : fmt::format("did you mean '{}'?", meant)};
}

std::string missing(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_required() && option->count() == 0) {
      return fmt::format("{} is missing: {}", option->get_name(), option->get_description());
    }
  }
  return "a command is missing";
}

/// CLI11 names the option in its text alone.
std::string option_in(const std::string& text) {
  const auto begin = text.find("--");
  return begin == std::string::npos ? text.substr(0, text.find(':'))
                                    : text.substr(begin, text.find_first_of(": =", begin) - begin);
}

std::string not_converted(const CLI::App& command, const std::string& text) {
  const std::string name = option_in(text);
  const CLI::Option* option = command.get_option_no_throw(name);
  const std::string type = option == nullptr ? "" : option->get_type_name();
  const std::string expected = type.find("INT") != std::string::npos ? "a whole number in range" : "a number";
  const auto equals = text.find(" = ");
  if (option == nullptr || equals == std::string::npos) return text;
  return fmt::format("{}: expected {}, got '{}'", name, expected, text.substr(equals + 3));
}

std::string excluded(std::string text) {
  const std::string word = " excludes ";
  const auto place = text.find(word);
  return place == std::string::npos ? text : text.replace(place, word.size(), " cannot go together with ");
}

UsageError describe(const CLI::App& command, const CLI::ParseError& error) {
  const std::string text = error.what();
  const auto kind = static_cast<CLI::ExitCodes>(error.get_exit_code());
  const std::vector<std::string> left_over = command.remaining();
  if (!left_over.empty() && (kind == CLI::ExitCodes::RequiredError || kind == CLI::ExitCodes::ExtrasError)) {
    return not_understood(command, left_over);
  }
  if (kind == CLI::ExitCodes::RequiredError) return {missing(command), ""};
  if (kind == CLI::ExitCodes::ConversionError) return {not_converted(command, text), ""};
  if (kind == CLI::ExitCodes::ExcludesError) return {excluded(text), ""};
  if (kind == CLI::ExitCodes::ArgumentMismatch) {
    const bool too_many = text.find("Most") != std::string::npos;
    return {option_in(text) + (too_many ? ": given more than once" : ": its value is missing"), ""};
  }
  return {text, ""};
}

}  // namespace

CLI::Validator number_in(double least, double greatest) {
  const std::string range = fmt::format("from {:g} to {:g}", least, greatest);
  return {[=](std::string& word) {
            double number = std::nan("");
            const bool fits = CLI::detail::lexical_cast(word, number) && number >= least && number <= greatest;
            return fits ? std::string() : expected_number(range, word);
          },
          fmt::format("{:g} to {:g}", least, greatest)};
}

CLI::Validator not_negative() {
  return {[](std::string& word) {
            double number = std::nan("");
            const bool fits = CLI::detail::lexical_cast(word, number) && number >= 0.0 && std::isfinite(number);
            return fits ? std::string() : expected_number("that is not negative", word);
          },
          "0 or more"};
}

CLI::Validator one_of(const std::map<std::string, int>& numbers) {
  std::string names;
  for (const auto& [name, number] : numbers) names += (names.empty() ? "" : "|") + name;
  return {[numbers, names](std::string& word) {
            const auto found = numbers.find(CLI::detail::to_lower(word));
            if (found == numbers.end()) return fmt::format("expected {}, got '{}'", names, word);
            word = std::to_string(found->second);
            return std::string();
          },
          names};
}

void print_usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  std::string name = "strut";
  for (auto below = app.get_subcommands(); !below.empty(); below = command->get_subcommands()) {
    command = below.front();
    name += " " + command->get_name();
  }
  const auto [message, hint] = describe(*command, error);
  say(fmt::format("{}: error: {}\n", name, message));
  say(fmt::format("hint: {}{} --help tells more\n", hint.empty() ? "" : hint + " ", name));
}

}  // namespace strut::cli
