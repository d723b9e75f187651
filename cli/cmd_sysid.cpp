// SPDX-License-Identifier: MIT
// strut sysid: a linear state-space system from a table of inputs and outputs, with its noise, and a report of how good
// it is.
#include "commands.h"
#include "csv_table.h"
#include "input_files.h"
#include "sysid_report.h"
#include "terminal.h"
#include "usage.h"

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/sysid/initial_state.h>

namespace strut::cli {
namespace {

using sysid::Experiment;

constexpr int kRefineSteps = 20;  // Levenberg-Marquardt has settled or never will
constexpr double kMostTest = 0.9;

struct SysidArguments {
  std::string table, output, clip_column;
  std::vector<std::string> inputs, outputs;
  sysid::IdentifyOptions options{.max_order = 8, .max_radius = 0.999, .starts = sysid::Starts::kEvery};
  std::string order = "auto";
  double test_share = 0.0;
  int lags = 25;
  bool keep_means = false, refine = false, combine = false, json = false, force = false;
};

/// A check for CLI11: auto, gap or a number of states.
CLI::Validator order_word(int most) {
  return {[most](std::string& word) {
            const std::string wanted = CLI::detail::to_lower(word);
            int number = -1;
            const bool fits = wanted == "auto" || wanted == "gap" ||
                              (CLI::detail::lexical_cast(wanted, number) && number >= 0 && number <= most);
            word = wanted;
            return fits ? std::string() : fmt::format("expected auto, gap or 0 to {}, got '{}'", most, wanted);
          },
          ""};
}

/// The clips of a table with the group each belongs to, and which of them are for testing.
struct Clips {
  std::vector<Experiment> train, test;
  std::vector<int> groups;  ///< of the training clips: equal labels, equal groups
};

Experiment clip_of(const FrameMatrix& values, Eigen::Index begin, Eigen::Index end, Eigen::Index inputs) {
  return {values.block(begin, 0, end - begin, inputs),
          values.block(begin, inputs, end - begin, values.cols() - inputs)};
}

/// Where clips begin, and the number of rows at the end: where the label changes, another clip begins.
std::vector<Eigen::Index> borders(const CsvColumns& table) {
  std::vector<Eigen::Index> found;
  for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
    if (row == 0 || (!table.labels.empty() && table.labels[row] != table.labels[row - 1])) found.push_back(row);
  }
  found.push_back(table.values.rows());
  return found;
}

/// Of so many things, those left for training.
Eigen::Index training_part(Eigen::Index count, double test_share) {
  return count - std::lround(test_share * static_cast<double>(count));
}

/// The last share of the clips is for testing, or of the rows if there is one clip only.
Clips split(const CsvColumns& table, const SysidArguments& arguments) {
  const auto num_inputs = static_cast<Eigen::Index>(arguments.inputs.size());
  std::vector<Eigen::Index> border = borders(table);
  Eigen::Index num_train = training_part(static_cast<Eigen::Index>(border.size()) - 1, arguments.test_share);
  if (border.size() == 2) {
    const Eigen::Index half = training_part(border[1], arguments.test_share);
    if (half > 0 && half < border[1]) border.insert(border.begin() + 1, half);
    num_train = 1;
  }
  if (num_train == 0) throw BadInput(arguments.table, "all clips would be for testing", "make --test smaller");
  Clips clips;
  std::map<std::string, int> group_of;
  for (Eigen::Index k = 0; k + 1 < static_cast<Eigen::Index>(border.size()); ++k) {
    (k < num_train ? clips.train : clips.test).push_back(clip_of(table.values, border[k], border[k + 1], num_inputs));
    if (k >= num_train) continue;
    const std::string label = table.labels.empty() ? "" : table.labels[border[k]];
    clips.groups.push_back(group_of.try_emplace(label, static_cast<int>(group_of.size())).first->second);
  }
  return clips;
}

Eigen::RowVectorXd mean_of(const std::vector<Experiment>& clips, FrameMatrix Experiment::*signal) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero((clips.front().*signal).cols());
  double rows = 0.0;
  for (const Experiment& clip : clips) {
    sum += (clip.*signal).colwise().sum();
    rows += clip.num_frames();
  }
  return sum / rows;
}

void subtract_means(std::vector<Experiment>& clips, const Eigen::RowVectorXd& input, const Eigen::RowVectorXd& output) {
  for (Experiment& clip : clips) {
    clip.input.rowwise() -= input;
    clip.output.rowwise() -= output;
  }
}

/// Tests of what `explained` (a clip and the number of it: frames x outputs) leaves of the clips.
template <typename Explained>
sysid::ResidualTests test_rest(const std::vector<Experiment>& clips, Explained explained, int lags) {
  std::vector<FrameMatrix> residuals, inputs;
  for (std::size_t k = 0; k < clips.size(); ++k) {
    residuals.push_back(clips[k].output - explained(clips[k], k));
    inputs.push_back(clips[k].input);
  }
  return sysid::test_residuals(residuals, inputs, lags);
}

sysid::IdentifyOptions identify_options(const SysidArguments& arguments) {
  sysid::IdentifyOptions options = arguments.options;
  options.refine_iterations = arguments.refine ? kRefineSteps : 0;
  if (arguments.order == "auto") return options;
  options.order_rule = arguments.order == "gap" ? sysid::OrderRule::kGap : sysid::OrderRule::kFixed;
  if (arguments.order != "gap") options.max_order = std::stoi(arguments.order);
  return options;
}

/// One estimate, or the best mean of several.
sysid::Combined identify(const Clips& clips, const sysid::IdentifyOptions& options, bool combine,
                         Diagnostics& diagnostics) {
  if (combine) {
    return sysid::identify_combined(clips.train, clips.groups, {.identification = options}, &diagnostics);
  }
  const sysid::Identified found = sysid::identify(clips.train, clips.groups, options, &diagnostics);
  return {found.system, found.fit, {sysid::Estimate::kSubspace}, {found.fit}, found, 0.0};
}

SysidFindings find(const SysidArguments& arguments, Diagnostics& diagnostics) {
  std::vector<std::string> names = arguments.inputs;
  names.insert(names.end(), arguments.outputs.begin(), arguments.outputs.end());
  Clips clips = split(read_csv_columns(arguments.table, names, arguments.clip_column), arguments);
  Eigen::RowVectorXd input_mean = mean_of(clips.train, &Experiment::input);
  Eigen::RowVectorXd output_mean = mean_of(clips.train, &Experiment::output);
  if (arguments.keep_means) input_mean.setZero(), output_mean.setZero();
  subtract_means(clips.train, input_mean, output_mean);
  subtract_means(clips.test, input_mean, output_mean);
  const sysid::IdentifyOptions options = identify_options(arguments);
  sysid::Combined found = identify(clips, options, arguments.combine, diagnostics);
  sysid::NoiseModel noise = sysid::fit_noise_model(found.system, clips.train, options.block_rows, &diagnostics);
  std::vector<Eigen::VectorXd> states;
  for (const Experiment& clip : clips.train) states.push_back(sysid::estimate_initial_state(found.system, clip));
  const auto predicted = [&](const Experiment& clip, std::size_t k) {
    return predict(found.system, noise.gain, clip, states[k]);
  };
  const auto simulated = [&](const Experiment& clip, std::size_t k) {
    return simulate(found.system, clip.input, states[k]);
  };
  sysid::ResidualTests prediction = test_rest(clips.train, predicted, arguments.lags);
  sysid::ResidualTests simulation = test_rest(clips.train, simulated, arguments.lags);
  const SysidFits train_fits = fits_on(clips.train, found.system, noise.gain);
  const SysidFits test_fits = clips.test.empty() ? SysidFits() : fits_on(clips.test, found.system, noise.gain);
  return {arguments.table,
          arguments.inputs,
          arguments.outputs,
          std::move(clips.train),
          std::move(clips.test),
          std::move(input_mean),
          std::move(output_mean),
          std::move(found),
          std::move(noise),
          std::move(states),
          train_fits,
          test_fits,
          std::move(prediction),
          std::move(simulation)};
}

void check_names(const SysidArguments& arguments) {
  std::set<std::string> seen;
  for (const auto* names : {&arguments.inputs, &arguments.outputs}) {
    for (const std::string& name : *names) {
      if (name.empty()) throw BadInput(arguments.table, "a column asked for has no name");
      if (!seen.insert(name).second) {
        throw BadInput(arguments.table, fmt::format("the column '{}' is asked for twice", name));
      }
    }
  }
}

void run(const SysidArguments& arguments) {
  const Overwrite overwrite = overwrite_if(arguments.force);
  if (!arguments.output.empty()) check_output(arguments.output, {arguments.table}, overwrite);
  check_names(arguments);
  PrintedDiagnostics diagnostics;
  const SysidFindings findings = naming_the_file(arguments.table, [&] { return find(arguments, diagnostics); });
  const auto text = [&] {
    return report_as_json(findings).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  };
  if (!arguments.output.empty()) write_file(arguments.output, text(), overwrite);
  arguments.json ? fmt::print("{}", text()) : print_report(findings);
}

void add_method_options(CLI::App& command, SysidArguments& arguments) {
  constexpr int kMostStates = 20;
  sysid::IdentifyOptions& options = arguments.options;
  command
      .add_option("--order", arguments.order,
                  "Number of states. auto: judged on clips left out (of a single clip, on parts); gap: where the "
                  "singular values fall most; or the number itself (default: auto)")
      ->check(order_word(kMostStates))
      ->type_name("ORDER");
  command.add_option("--max-order", options.max_order, "Largest number of states tried (default: 8)")
      ->check(number_in(0, kMostStates).description(""))
      ->type_name("N");
  command
      .add_option("--block-rows", options.block_rows,
                  "Past and future of the subspace step [rows]; fewer where clips are short (default: 10)")
      ->check(number_in(2, 100).description(""))
      ->type_name("N");
  command.add_option("--weighting", options.weighting, "Of the subspace step: n4sid, moesp or cva (default: cva)")
      ->transform(one_of({{"n4sid", static_cast<int>(sysid::Weighting::kN4sid)},
                          {"moesp", static_cast<int>(sysid::Weighting::kMoesp)},
                          {"cva", static_cast<int>(sysid::Weighting::kCva)}})
                      .description(""))
      ->type_name("n4sid|moesp|cva");
  command
      .add_option("--bd", options.input_matrices,
                  "B and D by least squares on the simulated output, or on estimated states (default: simulation)")
      ->transform(one_of({{"simulation", static_cast<int>(sysid::InputMatrices::kSimulation)},
                          {"states", static_cast<int>(sysid::InputMatrices::kStates)}})
                      .description(""))
      ->type_name("simulation|states");
  command.add_flag("--refine", arguments.refine,
                   "Try Levenberg-Marquardt steps on all of A, B, C and D, kept where clips left out are better with "
                   "them (default: no)");
  command.add_flag("--combine", arguments.combine,
                   "Of many clips: make other estimates too (on filtered clips, regularized, static) and take the mean "
                   "of those that predicts clips left out best (default: no)");
  command
      .add_option("--radius", options.max_radius,
                  "Largest modulus of a pole: how slowly the system may forget (default: 0.999)")
      ->check(number_in(0.01, 0.99999).description(""))
      ->type_name("X");
  command.add_option("--ridge", options.ridge, "Shrinkage of B and D, 0 for none (default: 0)")
      ->check(number_in(0.0, 10.0).description(""))
      ->type_name("X");
}

}  // namespace

void add_sysid(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("sysid", "Identify a linear state-space system from a table of inputs and outputs");
  const auto arguments = std::make_shared<SysidArguments>();
  command
      ->add_option("table", arguments->table,
                   "Comma-separated values: a line of column names, then a line per sample, equally spaced in time")
      ->required()
      ->type_name("TABLE");
  command->add_option("--inputs", arguments->inputs, "Names of the input columns, separated by commas")
      ->required()
      ->delimiter(',')
      ->type_name("NAMES");
  command->add_option("--outputs", arguments->outputs, "Names of the output columns, separated by commas")
      ->required()
      ->delimiter(',')
      ->type_name("NAMES");
  command
      ->add_option("--clip", arguments->clip_column,
                   "Column that tells clips (experiments) apart: where its text changes, another begins; clips of one "
                   "text are left out together (default: all rows are one clip)")
      ->type_name("NAME");
  command
      ->add_option("--test", arguments->test_share,
                   "Keep the last of the clips (of a single clip: of its rows) for testing, this share of them "
                   "(default: 0)")
      ->check(number_in(0.0, kMostTest).description(""))
      ->type_name("SHARE");
  add_method_options(*command, *arguments);
  command->add_flag("--keep-means", arguments->keep_means,
                    "Take the signals as they are (default: the training rows' means are taken off, and written)");
  command->add_option("--lags", arguments->lags, "Lags of the residuals' tests [rows] (default: 25)")
      ->check(number_in(1, 1000).description(""))
      ->type_name("N");
  command->add_option("-o,--output", arguments->output, "Write the system and the report as JSON (default: none)")
      ->type_name("FILE");
  command->add_flag("--json", arguments->json, "Print what -o writes (default: a readable report)");
  command->add_flag("--force", arguments->force, "Overwrite a file that exists (default: refuse)");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
