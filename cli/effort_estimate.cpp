// SPDX-License-Identifier: MIT
// strut effort estimate: a first Effort of every matched fragment from how it moves, to start labelling from; once
// people have labelled some, as they label. Kept apart from labels.
#include "effort_commands.h"
#include "input_files.h"
#include "terminal.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <strut/core/error.h>
#include <strut/effort/effort_estimate.h>
#include <strut/effort/fragment_database.h>
#include <strut/effort/fragment_names.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;
using effort::FragmentDatabase;
using effort::FragmentRecord;

struct EstimateArguments {
  std::string database, rater;
  bool show = false, json = false;
};

/// Fragments that can be estimated, and how they move.
struct Described {
  std::vector<FragmentRecord> fragments;
  std::vector<Eigen::VectorXd> descriptors;
  std::map<int, int> group_index;  ///< of the database's groups
};

Described describe_all(const FragmentDatabase& database, Diagnostics& diagnostics) {
  Described described;
  ProgressLine line("estimating");
  const std::vector<FragmentRecord> all = database.fragments();
  int done = 0;
  for (const FragmentRecord& fragment : all) {
    line.update("fragments", done++, static_cast<int>(all.size()));
    if (fragment.group < 0) continue;
    try {
      described.descriptors.push_back(effort::describe(database.motion(fragment)));
    } catch (const InvalidArgument&) {
      diagnostics.warn(database.path(), "fragments shorter than 4 frames have no estimate");
      continue;
    }
    described.fragments.push_back(fragment);
    described.group_index.emplace(fragment.group, static_cast<int>(described.group_index.size()));
  }
  if (described.fragments.empty()) {
    throw BadInput(database.path(), "no fragment of it belongs to a group", "strut effort match groups them");
  }
  return described;
}

std::vector<effort::DescriptorScale> scales_of(const Described& described) {
  std::vector<std::vector<Eigen::VectorXd>> rows(described.group_index.size());
  for (std::size_t i = 0; i < described.fragments.size(); ++i) {
    rows[static_cast<std::size_t>(described.group_index.at(described.fragments[i].group))].push_back(
        described.descriptors[i]);
  }
  std::vector<effort::DescriptorScale> scales;
  for (const auto& group : rows) {
    Eigen::MatrixXd stacked(std::ssize(group), effort::kNumDescriptors);
    for (std::size_t i = 0; i < group.size(); ++i) stacked.row(static_cast<Eigen::Index>(i)) = group[i].transpose();
    scales.push_back(effort::descriptor_scale(stacked));
  }
  return scales;
}

std::vector<effort::LabelledDescriptors> labelled(const FragmentDatabase& database, const std::string& rater,
                                                  const Described& described) {
  std::map<effort::RecordId, effort::Rating> labels;
  const auto means = database.mean_labels(rater);
  if (means.empty() && !rater.empty()) {
    throw BadInput(database.path(), "'" + rater + "' labelled nothing in it", "strut effort labels shows who did");
  }
  for (const auto& mean : means) {
    if (mean.target.kind == effort::TargetKind::kFragment) labels.emplace(mean.target.id, mean.mean);
  }
  std::vector<effort::LabelledDescriptors> found;
  for (std::size_t i = 0; i < described.fragments.size(); ++i) {
    const auto label = labels.find(described.fragments[i].id);
    if (label == labels.end()) continue;
    found.push_back({described.group_index.at(described.fragments[i].group), described.descriptors[i],
                     label->second.head<effort::kNumPredictedFactors>()});
  }
  return found;
}

/// Whose labels the estimates follow.
std::string whom(const EstimateArguments& arguments) {
  return arguments.rater.empty() ? "people label" : arguments.rater + " labels";
}

void print_row(const FragmentRecord& fragment, const effort::EstimateRecord& estimate, const std::string& name) {
  fmt::print("{:>8} {:>6}", fragment.id, fragment.group);
  for (int k = 0; k < effort::kNumPredictedFactors; ++k) {
    fmt::print("  {:+6.2f} ({:.2f})", estimate.effort[k], estimate.confidence[k]);
  }
  fmt::print("  {}\n", name);
}

void print_table(const EstimateArguments& arguments, const Described& described,
                 const std::vector<effort::EstimateRecord>& estimates, const FragmentDatabase& database) {
  constexpr std::size_t kMostShown = 20;
  const auto names = effort::fragment_names(database);
  const std::size_t shown = arguments.show ? estimates.size() : std::min(kMostShown, estimates.size());
  fmt::print("{:>8} {:>6}  {:>13}  {:>13}  {:>13}  (confidence)\n", "fragment", "group", "flow", "weight", "time");
  for (std::size_t i = 0; i < shown; ++i) {
    print_row(described.fragments[i], estimates[i], names.at(estimates[i].fragment));
  }
  if (shown < estimates.size()) fmt::print("and {} more (--all)\n", estimates.size() - shown);
}

void print_basis(const EstimateArguments& arguments, const effort::KinematicEstimator& estimator) {
  for (const auto factor : {effort::kFlow, effort::kWeight, effort::kTime}) {
    const auto place = static_cast<std::size_t>(factor);
    if (estimator.is_fitted(factor)) {
      fmt::print("{}: as {}, off by {:.2f} where a label is left out\n", effort::kFactorNames.at(place),
                 whom(arguments), estimator.numbers().left_out_error[factor]);
    } else {
      fmt::print("{}: a rule of thumb; from {} labelled fragments on ({} so far), as {}\n",
                 effort::kFactorNames.at(place), effort::kFewestLabels, estimator.numbers().num_labels[factor],
                 whom(arguments));
    }
  }
}

void print_json(const EstimateArguments& arguments, const Described& described,
                const std::vector<effort::EstimateRecord>& estimates, const effort::KinematicEstimator& estimator) {
  Json factors = Json::object(), fragments = Json::array();
  for (const auto factor : {effort::kFlow, effort::kWeight, effort::kTime}) {
    Json& told = factors[effort::kFactorNames.at(static_cast<std::size_t>(factor))];
    told = {{"from_labels", estimator.is_fitted(factor)}, {"labels", estimator.numbers().num_labels[factor]}};
    if (estimator.is_fitted(factor)) told["left_out_rmse"] = estimator.numbers().left_out_error[factor];
  }
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const FragmentRecord& fragment = described.fragments[i];
    Json told = {{"fragment", fragment.id},
                 {"group", fragment.group},
                 {"clip", fragment.clip_name},
                 {"begin_frame", fragment.frames.begin},
                 {"end_frame", fragment.frames.end}};
    for (int k = 0; k < effort::kNumPredictedFactors; ++k) {
      told[effort::kFactorNames.at(static_cast<std::size_t>(k))] = {{"estimate", estimates[i].effort[k]},
                                                                    {"confidence", estimates[i].confidence[k]}};
    }
    fragments.push_back(std::move(told));
  }
  Json all = {{"database", arguments.database}, {"factors", std::move(factors)}, {"fragments", std::move(fragments)}};
  if (!arguments.rater.empty()) all["rater"] = arguments.rater;
  fmt::print("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
}

void print_next(const std::string& database) {
  fmt::print("next: strut effort learn {} --estimates -o moves.struteffort\n", database);
  fmt::print("or label first: strut effort labels {} --export labels.csv --estimates makes a table to fill in\n",
             database);
}

void run(const EstimateArguments& arguments) {
  FragmentDatabase database = FragmentDatabase::open(arguments.database, effort::Access::kReadWrite);
  PrintedDiagnostics diagnostics;
  const Described described = describe_all(database, diagnostics);
  const auto estimator =
      effort::KinematicEstimator::fit(scales_of(described), labelled(database, arguments.rater, described));
  std::vector<effort::EstimateRecord> estimates;
  for (std::size_t i = 0; i < described.fragments.size(); ++i) {
    const auto estimate =
        estimator.estimate(described.group_index.at(described.fragments[i].group), described.descriptors[i]);
    estimates.push_back({described.fragments[i].id, estimate.effort, estimate.confidence});
  }
  database.set_estimates(estimates);
  if (arguments.json) return print_json(arguments, described, estimates, estimator);
  print_table(arguments, described, estimates, database);
  print_basis(arguments, estimator);
  print_next(arguments.database);
}

}  // namespace

void add_effort_estimate(CLI::App& app) {
  auto arguments = std::make_shared<EstimateArguments>();
  CLI::App* command =
      app.add_subcommand("estimate", "Estimate every fragment's Effort from how it moves, to start from");
  command->add_option("database", arguments->database, "Database that strut effort match has grouped")->required();
  command->add_option("--rater", arguments->rater, "Estimate as this rater labels (default: as people do)")
      ->type_name("NAME");
  command->add_flag("--all", arguments->show, "Show all estimates, not the first twenty");
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
