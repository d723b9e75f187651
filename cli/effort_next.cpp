// SPDX-License-Identifier: MIT
// strut effort next: names the blends whose labels would help most, keeps them in the database so that they can be
// labelled, and writes a table to fill in and clips to look at.
#include "effort_commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>
#include <strut/effort/learn_effort.h>
#include <strut/effort/next_labels.h>
#include <strut/effort/space_time_blend.h>
#include <strut/io/bvh.h>

namespace strut::cli {
namespace {

struct NextArguments {
  std::string database, table, folder;
  effort::LearnOptions learn;
  int count = 10;
  bool force = false;
};

/// A suggested blend with its number in the database.
struct NumberedBlend {
  effort::RecordId id = 0;
  effort::SuggestedBlend blend;
};

effort::SpaceTimeBlend space_time_blend(const effort::EffortExamples& examples, const effort::FragmentPair& pair) {
  return {examples.fragments[static_cast<std::size_t>(pair.first)].motion,
          examples.fragments[static_cast<std::size_t>(pair.second)].motion};
}

bool can_be_blended(const effort::EffortExamples& examples, const effort::FragmentPair& pair) {
  try {
    space_time_blend(examples, pair);
    return true;
  } catch (const InvalidArgument&) {
    return false;  // too far apart in posture or duration
  }
}

/// The blends to ask about. Which pairs can be blended is tried only of those that would be asked about, for trying
/// takes milliseconds.
std::vector<effort::SuggestedBlend> suggestions(const effort::EffortExamples& examples, const NextArguments& arguments,
                                                Diagnostics& diagnostics) {
  const auto regression = effort::fit_effort_regression(effort::labelled_fragments(examples), examples.blends,
                                                        arguments.learn.regression, &diagnostics);
  effort::NextLabelOptions options;
  options.count = arguments.count;
  std::vector<effort::FragmentPair> pairs = examples.pairs;
  while (true) {
    auto found = effort::next_labels(regression, effort::candidate_blends(regression, pairs, options), options);
    const std::size_t before = pairs.size();
    for (const effort::SuggestedBlend& blend : found) {
      const effort::FragmentPair pair{blend.first, blend.second};
      if (!can_be_blended(examples, pair)) std::erase(pairs, pair);
    }
    if (pairs.size() == before) return found;
  }
}

const std::string& name_of(const effort::EffortExamples& examples, int fragment) {
  return examples.fragments[static_cast<std::size_t>(fragment)].name;
}

std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

/// A line per blend in the columns of labels, with empty fields for what a rater says; beside them, for people, the
/// blend's number and what its fragments are called.
std::string table_of(const effort::EffortExamples& examples, const std::vector<NumberedBlend>& blends,
                     const std::string& rater) {
  std::string text =
      "first,second,alpha,rater,labelled_at,source,flow,weight,time,space,repeat,comment,"
      "blend,first_name,second_name\n";
  for (const auto& [id, blend] : blends) {
    const auto id_of = [&](int fragment) { return examples.ids[static_cast<std::size_t>(fragment)]; };
    text += fmt::format("{},{},{},{},,person,,,,,,,{},{},{}\n", id_of(blend.first), id_of(blend.second), blend.alpha,
                        rater.empty() ? "" : in_quotes(rater), id, in_quotes(name_of(examples, blend.first)),
                        in_quotes(name_of(examples, blend.second)));
  }
  return text;
}

std::string clip_path(const std::string& folder, effort::RecordId id) {
  return (std::filesystem::path(folder) / fmt::format("blend-{}.bvh", id)).string();
}

void write_clips(const effort::EffortExamples& examples, const std::vector<NumberedBlend>& blends,
                 const NextArguments& arguments, Diagnostics& diagnostics) {
  std::error_code failure;
  std::filesystem::create_directories(arguments.folder, failure);
  if (failure) throw FileError(FileAction::kWrite, arguments.folder, failure.message());
  for (const auto& [id, blend] : blends) {
    check_writable(clip_path(arguments.folder, id), overwrite_if(arguments.force));
  }
  for (const auto& [id, blend] : blends) {
    const Motion motion = space_time_blend(examples, {blend.first, blend.second}).at(blend.alpha).motion;
    write_bvh(clip_path(arguments.folder, id), motion, default_layout(motion.skeleton()), overwrite_if(arguments.force),
              &diagnostics);
  }
}

std::string plus_minus(const effort::EffortPrediction& expected, int factor) {
  if (!effort::is_rated(expected.effort[factor])) return "not rated";
  return fmt::format("{:+.2f} ({:.2f})", expected.effort[factor], expected.deviation[factor]);
}

void print_suggestions(const effort::EffortExamples& examples, const std::vector<NumberedBlend>& blends) {
  fmt::print("{} blends labelled so far; a label of these would tell most about all others:\n", examples.blends.size());
  fmt::print("{:>6} {:>6}  {:<14}{:<14}{:<14}{:<8}{}\n", "blend", "alpha", "flow (+-)", "weight (+-)", "time (+-)",
             "gain", "of");
  const double most = blends.front().blend.gain;
  for (const auto& [id, blend] : blends) {
    fmt::print("{:>6} {:>6.2f}  {:<14}{:<14}{:<14}{:<8}{} and {}\n", id, blend.alpha, plus_minus(blend.expected, 0),
               plus_minus(blend.expected, 1), plus_minus(blend.expected, 2),
               fmt::format("{:.0f} %", 100.0 * blend.gain / most), name_of(examples, blend.first),
               name_of(examples, blend.second));
  }
  fmt::print("gain: how much it lowers the expected error of all blends, the first's being 100 %\n");
}

void run(const NextArguments& arguments) {
  if (!arguments.table.empty()) {
    check_output(arguments.table, {arguments.database}, overwrite_if(arguments.force));
  }
  PrintedDiagnostics diagnostics;
  auto database = effort::FragmentDatabase::open(arguments.database, effort::Access::kReadWrite);
  const effort::EffortExamples examples = naming_the_file(
      arguments.database, [&] { return effort::effort_examples(database, arguments.learn, &diagnostics); });
  const auto found = suggestions(examples, arguments, diagnostics);
  if (found.empty()) {
    throw BadInput(arguments.database, "no blend is left to ask about",
                   "strut effort match finds more pairs where there are more clips");
  }
  // Numbers are kept only if all that was asked for could be written.
  effort::FragmentDatabase::Transaction transaction(database);
  std::vector<NumberedBlend> blends;
  for (const effort::SuggestedBlend& blend : found) {
    const auto id_of = [&](int fragment) { return examples.ids[static_cast<std::size_t>(fragment)]; };
    blends.push_back({database.add_blend(id_of(blend.first), id_of(blend.second), blend.alpha), blend});
  }
  if (!arguments.folder.empty()) write_clips(examples, blends, arguments, diagnostics);
  if (!arguments.table.empty()) {
    write_file(arguments.table, table_of(examples, blends, arguments.learn.rater), overwrite_if(arguments.force));
  }
  transaction.commit();
  print_suggestions(examples, blends);
}

}  // namespace

void add_effort_next(CLI::App& app) {
  auto arguments = std::make_shared<NextArguments>();
  CLI::App* command = app.add_subcommand("next", "Name the blends whose labels would help most");
  command->add_option("database", arguments->database, "Database of fragments")->required();
  command->add_option("--count", arguments->count, "How many blends (default 10)")
      ->check(number_in(1, 1000))
      ->type_name("N");
  command->add_option("--csv", arguments->table, "Write a table of labels to fill in")->type_name("FILE");
  command->add_option("--write", arguments->folder, "Write the blends as BVH clips into this folder, to look at")
      ->type_name("FOLDER");
  CLI::Option* estimates = command->add_flag("--estimates", arguments->learn.from_estimates,
                                             "Where fragments are not labelled yet, go by the program's estimates");
  command
      ->add_option("--rater", arguments->learn.rater, "Go by this rater's labels alone (default: the mean of people)")
      ->type_name("NAME")
      ->excludes(estimates);
  command->add_flag("--force", arguments->force, "Overwrite existing files");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
