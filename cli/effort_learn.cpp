// SPDX-License-Identifier: MIT
// strut effort learn: from a database of labelled fragments and blends to an effort model, and what it can be expected
// to predict.
#include "effort_commands.h"
#include "effort_model_info.h"
#include "effort_report.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <strut/core/version.h>
#include <strut/effort/effort_model_io.h>
#include <strut/effort/effort_validation.h>
#include <strut/effort/learn_effort.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

struct LearnArguments {
  std::string database, output;
  effort::LearnOptions options;
  bool validates = true, json = false, force = false;
};

/// A number for every performer; empty if none or only one is known.
std::vector<int> numbers_of(const std::vector<std::string>& performers) {
  std::map<std::string, int> number;
  std::vector<int> numbers;
  for (const std::string& name : performers) {
    if (name.empty()) return {};
    numbers.push_back(number.emplace(name, static_cast<int>(number.size())).first->second);
  }
  return number.size() > 1 ? numbers : std::vector<int>{};
}

/// The action that most fragments of each group are of, else its number.
std::vector<std::string> group_names(const effort::EffortExamples& examples) {
  std::vector<std::map<std::string, int>> counts(examples.scales.size());
  for (std::size_t i = 0; i < examples.fragments.size(); ++i) {
    ++counts[static_cast<std::size_t>(examples.fragments[i].group)][examples.actions[i]];
  }
  std::vector<std::string> names;
  for (std::size_t group = 0; group < counts.size(); ++group) {
    const auto most = std::max_element(counts[group].begin(), counts[group].end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    names.push_back(most->first.empty() ? fmt::format("group {}", group) : most->first);
  }
  return names;
}

std::vector<effort::ValidationResult> validate(const effort::EffortExamples& examples,
                                               const effort::RegressionOptions& regression) {
  std::vector<effort::ValidationResult> results;
  if (examples.blends.empty()) return results;
  const auto fragments = effort::labelled_fragments(examples);
  const std::vector<int> performers = numbers_of(examples.performers);
  effort::ValidationOptions options;
  options.regression = regression;
  for (const auto split :
       {effort::ValidationSplit::kFragment, effort::ValidationSplit::kAction, effort::ValidationSplit::kPerformer}) {
    if (split == effort::ValidationSplit::kPerformer && performers.empty()) continue;
    results.push_back(effort::cross_validate(fragments, examples.blends, split, options, performers));
  }
  return results;
}

Json number_or_null(double value) {
  return effort::is_rated(value) ? Json(value) : Json(nullptr);
}

Json validation_as_json(const std::vector<effort::ValidationResult>& results) {
  Json all = Json::object();
  for (const effort::ValidationResult& result : results) {
    Json methods = Json::object();
    for (const effort::MethodScore& score : result.methods) {
      methods[effort::kRegressionMethodNames.at(static_cast<std::size_t>(score.method))] =
          number_or_null(score.mean_error);
    }
    all[effort::kValidationSplitNames.at(static_cast<std::size_t>(result.split))] = std::move(methods);
  }
  return all;
}

std::string provenance_of(const LearnArguments& arguments, const effort::EffortExamples& examples,
                          const std::vector<effort::ValidationResult>& validation) {
  const Json all = {{"strut", version()},
                    {"database", arguments.database},
                    {"labels", examples.num_labels},
                    {"synthetic", examples.are_synthetic},
                    {"labelled_fragments", examples.fragments.size()},
                    {"labelled_blends", examples.blends.size()},
                    {"raters", examples.raters},
                    {"left_out_rmse", validation_as_json(validation)}};
  // A file's name may be in any encoding.
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void print_examples(const effort::EffortExamples& examples, bool are_estimates) {
  std::string raters;
  for (const std::string& rater : examples.raters) raters += (raters.empty() ? "" : ", ") + rater;
  fmt::print("{} {}{}: {} fragments in {} groups, {} pairs that can be blended, {} blends labelled\n",
             examples.num_labels, are_estimates ? "estimates" : "labels of ", raters, examples.fragments.size(),
             examples.scales.size(), examples.pairs.size(), examples.blends.size());
}

void run(const LearnArguments& arguments) {
  check_output(arguments.output, {arguments.database}, overwrite_if(arguments.force));
  PrintedDiagnostics diagnostics;
  const auto database = effort::FragmentDatabase::open(arguments.database);
  const effort::EffortExamples examples = naming_the_file(
      arguments.database, [&] { return effort::effort_examples(database, arguments.options, &diagnostics); });
  ProgressLine line("learning");
  line.update("left-out labels", 0, 2);
  const auto validation =
      arguments.validates ? validate(examples, arguments.options.regression) : std::vector<effort::ValidationResult>{};
  line.update("model", 1, 2);
  const auto model =
      effort::learn_effort(examples, arguments.options, provenance_of(arguments, examples, validation), &diagnostics);
  effort::write_effort_model(arguments.output, *model, overwrite_if(arguments.force));
  if (arguments.json) {
    fmt::print("{}\n",
               effort_model_as_json(arguments.output, *model).dump(2, ' ', false, Json::error_handler_t::replace));
    return;
  }
  print_examples(examples, arguments.options.from_estimates);
  if (!validation.empty()) fmt::print("{}", validation_report(validation, group_names(examples)));
  print_effort_model(arguments.output, *model);
  fmt::print("next: strut effort apply {} clip.bvh --time 0.8 -o sudden.bvh\n", arguments.output);
}

}  // namespace

void add_effort_learn(CLI::App& app) {
  auto arguments = std::make_shared<LearnArguments>();
  CLI::App* command = app.add_subcommand("learn", "Learn how labels of fragments carry over to their blends");
  command->add_option("database", arguments->database, "Database of fragments")->required();
  command->add_option("-o,--output", arguments->output, "Effort model (.struteffort) to write")->required();
  CLI::Option* estimates = command->add_flag("--estimates", arguments->options.from_estimates,
                                             "Learn from the program's estimates instead of people's labels");
  command
      ->add_option("--rater", arguments->options.rater,
                   "Learn from this rater's labels alone (default: the mean of people)")
      ->type_name("NAME")
      ->excludes(estimates);
  std::map<std::string, int> methods;
  for (int m = 0; m < effort::kNumRegressionMethods; ++m) {
    methods[effort::kRegressionMethodNames.at(static_cast<std::size_t>(m))] = m;
  }
  command
      ->add_option_function<int>(
          "--method",
          [arguments](int method) {
            arguments->options.regression.method = static_cast<effort::RegressionMethod>(method);
          },
          "How labels of blends are predicted: residual (linear labels and what is learnt of the rest; default), svr "
          "(support vectors, as the paper has it), linear, nearest")
      ->transform(one_of(methods))
      ->type_name("METHOD");
  command->add_flag_callback(
      "--no-validation", [arguments] { arguments->validates = false; }, "Do not predict left-out labels");
  command->add_flag("--json", arguments->json, "Print what strut info --json prints of the model");
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
