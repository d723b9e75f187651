// SPDX-License-Identifier: MIT
// strut effort labels: who labelled what and how well they repeat themselves; labels in and out as a table.
#include "effort_commands.h"
#include "input_files.h"
#include "terminal.h"

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <strut/effort/fragment_database.h>
#include <strut/effort/label_table.h>

namespace strut::cli {
namespace {

using effort::FragmentDatabase;
using effort::LabelRecord;

struct LabelsArguments {
  std::string database, table_in, table_out;
  bool estimates = false, force = false;
};

/// One rater's labels, and how far blind repeats lie from the first labels of the same target.
struct RaterReport {
  int labels = 0, repeats = 0;
  std::map<effort::LabelTarget, effort::Rating> first;
  effort::Rating squares = effort::Rating::Zero();
  Eigen::Vector4i count = Eigen::Vector4i::Zero();
};

std::map<std::string, RaterReport> reports_of(const FragmentDatabase& database) {
  std::map<std::string, RaterReport> reports;
  const auto labels = database.labels();
  for (const LabelRecord& label : labels) {
    RaterReport& report = reports[label.rater];
    ++report.labels;
    if (!label.is_repeat) report.first.emplace(label.target, label.rating);
  }
  for (const LabelRecord& label : labels) {
    RaterReport& report = reports[label.rater];
    const auto first = report.first.find(label.target);
    if (!label.is_repeat || first == report.first.end()) continue;
    ++report.repeats;
    for (int k = 0; k < effort::kNumFactors; ++k) {
      const double change = label.rating[k] - first->second[k];
      if (!effort::is_rated(change)) continue;
      report.squares[k] += change * change;
      ++report.count[k];
    }
  }
  return reports;
}

void print_raters(const FragmentDatabase& database) {
  const auto reports = reports_of(database);
  if (reports.empty()) {
    fmt::print("{}: no labels; strut effort labels {} --export labels.csv --estimates makes a table to fill in\n",
               database.path(), database.path());
    return;
  }
  fmt::print("{:<16} {:>7} {:>8}   how far repeats differ (RMS): flow, weight, time, space\n", "rater", "labels",
             "repeats");
  for (const auto& [rater, report] : reports) {
    std::string differences;
    for (int k = 0; k < effort::kNumFactors; ++k) {
      differences +=
          report.count[k] == 0 ? "      -" : fmt::format(" {:6.3f}", std::sqrt(report.squares[k] / report.count[k]));
    }
    fmt::print("{:<16} {:>7} {:>8}  {}\n", rater, report.labels, report.repeats, differences);
  }
}

void run(const LabelsArguments& arguments) {
  if (!arguments.table_out.empty()) {
    check_output(arguments.table_out, {arguments.database}, overwrite_if(arguments.force));
  }
  const bool writes = !arguments.table_in.empty();
  FragmentDatabase database =
      FragmentDatabase::open(arguments.database, writes ? effort::Access::kReadWrite : effort::Access::kRead);
  if (writes) {
    const auto result = effort::import_labels(database, arguments.table_in);
    fmt::print("{} labels added, {} there already, {} estimates left out\n", result.added, result.repeated,
               result.estimates);
  }
  if (!arguments.table_out.empty()) {
    write_file(arguments.table_out, effort::format_labels(database, arguments.estimates),
               overwrite_if(arguments.force));
    fmt::print("written {}\n", arguments.table_out);
  }
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
  command->add_flag("--force", arguments->force, "Overwrite an existing table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
