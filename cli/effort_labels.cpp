// SPDX-License-Identifier: MIT
// strut effort labels: who labelled what and how well they repeat themselves; labels in and out as a table.
#include "effort_commands.h"
#include "input_files.h"
#include "terminal.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <strut/effort/fragment_database.h>
#include <strut/effort/label_table.h>
#include <strut/effort/rater_consistency.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;
using effort::FragmentDatabase;
using effort::LabelRecord;

struct LabelsArguments {
  std::string database, table_in, table_out;
  bool estimates = false, json = false, force = false;
};

/// By name.
std::map<std::string, effort::RaterConsistency> reports_of(const FragmentDatabase& database) {
  const auto labels = database.labels();
  std::map<std::string, effort::RaterConsistency> reports;
  for (const LabelRecord& label : labels) reports[label.rater];
  for (auto& [rater, report] : reports) report = effort::rater_consistency(labels, rater);
  return reports;
}

void print_raters(const FragmentDatabase& database) {
  const auto reports = reports_of(database);
  if (reports.empty()) {
    fmt::print("{}: no labels; strut effort labels {} --export labels.csv --estimates makes a table to fill in\n",
               database.path(), database.path());
    return;
  }
  fmt::print("{:<16} {:<9} {:>7} {:>8}   how far repeats differ (RMS): flow, weight, time, space\n", "rater", "source",
             "labels", "repeats");
  for (const auto& [rater, report] : reports) {
    std::string differences;
    for (int k = 0; k < effort::kNumFactors; ++k) {
      const double value = report.rms_difference[k];
      differences += effort::is_rated(value) ? fmt::format(" {:6.3f}", value) : "      -";
    }
    fmt::print("{:<16} {:<9} {:>7} {:>8}  {}\n", rater, report.is_synthetic ? "synthetic" : "person", report.num_labels,
               report.num_repeats, differences);
  }
}

/// The raters, and what an import did.
void print_json(const FragmentDatabase& database, const std::optional<effort::LabelImport>& taken) {
  Json all = {{"database", database.path()}};
  if (taken) {
    all["import"] = {
        {"added", taken->added}, {"there_already", taken->repeated}, {"estimates_left_out", taken->estimates}};
  }
  all["raters"] = Json::array();
  for (const auto& [rater, report] : reports_of(database)) {
    Json differences = Json::object();
    for (int k = 0; k < effort::kNumFactors; ++k) {
      const double value = report.rms_difference[k];
      if (effort::is_rated(value)) differences[effort::kFactorNames.at(static_cast<std::size_t>(k))] = value;
    }
    all["raters"].push_back({{"rater", rater},
                             {"source", report.is_synthetic ? "synthetic" : "person"},
                             {"labels", report.num_labels},
                             {"repeats", report.num_repeats},
                             {"repeats_differ_rms", std::move(differences)}});
  }
  fmt::print("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
}

void tell(const effort::LabelImport& taken, const FragmentDatabase& database) {
  fmt::print("{} labels added, {} there already, {} estimates left out\n", taken.added, taken.repeated,
             taken.estimates);
  fmt::print("next: strut effort learn {} -o moves.struteffort\n", database.path());
}

void run(const LabelsArguments& arguments) {
  if (!arguments.table_out.empty()) {
    check_output(arguments.table_out, {arguments.database}, overwrite_if(arguments.force));
  }
  const bool writes = !arguments.table_in.empty();
  FragmentDatabase database =
      FragmentDatabase::open(arguments.database, writes ? effort::Access::kReadWrite : effort::Access::kRead);
  std::optional<effort::LabelImport> taken;
  if (writes) taken = effort::import_labels(database, arguments.table_in);
  if (taken && !arguments.json) tell(*taken, database);
  if (!arguments.table_out.empty()) {
    write_file(arguments.table_out, effort::format_labels(database, arguments.estimates),
               overwrite_if(arguments.force));
    if (!arguments.json) fmt::print("written {}\n", arguments.table_out);
  }
  if (arguments.json) return print_json(database, taken);
  if (!writes && arguments.table_out.empty()) print_raters(database);
}

}  // namespace

void add_effort_labels(CLI::App& app) {
  auto arguments = std::make_shared<LabelsArguments>();
  CLI::App* command = app.add_subcommand("labels", "Show, import or export what people say of fragments and blends");
  command->add_option("database", arguments->database, "Database made by strut effort segment")->required();
  command->add_option("--import", arguments->table_in,
                      "Take in labels (CSV): fragment, rater, labelled_at, flow, weight, time, space; all or none");
  command->add_option("--export", arguments->table_out, "Write all labels as such a table");
  command->add_flag("--estimates", arguments->estimates, "Export estimates too, named as such, to start from");
  command->add_flag("--json", arguments->json, "Print the raters, and what was taken in, as JSON");
  command->add_flag("--force", arguments->force, "Overwrite an existing table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
