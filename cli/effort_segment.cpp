// SPDX-License-Identifier: MIT
// strut effort segment: clips in, a database of suggested fragments out; cuts out and in again as a table to be edited.
#include "effort_commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <strut/core/error.h>
#include <strut/effort/cut_table.h>
#include <strut/effort/fragment_cuts.h>
#include <strut/effort/fragment_database.h>
#include <strut/io/bvh.h>

namespace strut::cli {
namespace {

using effort::FragmentDatabase;

struct SegmentArguments {
  std::string database, cuts_out, cuts_in, performer, action;
  std::vector<std::string> clips;
  bool replace = false, discard_labels = false, force = false;
  effort::CutOptions cuts;
};

effort::OnLabels on_labels(const SegmentArguments& arguments) {
  return arguments.discard_labels ? effort::OnLabels::kDiscard : effort::OnLabels::kRefuse;
}

std::optional<std::regex> pattern_of(const std::string& option, const std::string& pattern) {
  if (pattern.empty()) return std::nullopt;
  try {
    return std::regex(pattern);
  } catch (const std::regex_error&) {
    throw CLI::ValidationError(option, "expected a regular expression, got '" + pattern + "'");
  }
}

/// What the pattern finds in a file's name: its first group, or all of it.
std::string found_in(const std::string& path, const std::optional<std::regex>& pattern) {
  const std::string name = std::filesystem::path(path).filename().string();
  std::smatch match;
  if (!pattern || !std::regex_search(name, match, *pattern)) return {};
  return match.size() > 1 ? match[1].str() : match[0].str();
}

/// Adds clips one by one, so that an interrupted run can be taken up again.
class Segmenter {
 public:
  Segmenter(const SegmentArguments& arguments, Diagnostics& diagnostics)
      : arguments_(arguments),
        diagnostics_(diagnostics),
        performer_(pattern_of("--performer", arguments.performer)),
        action_(pattern_of("--action", arguments.action)) {
    if (std::filesystem::exists(arguments.database)) open();
  }

  void add(const std::string& path) {
    const std::string name = std::filesystem::path(path).lexically_normal().string();
    std::optional<effort::ClipRecord> there;
    if (database_) there = database_->find_clip(name);
    if (there && !arguments_.replace) {
      ++skipped_;
      return;
    }
    const Motion motion = read_bvh(path, {}, &diagnostics_).motion;
    if (motion.num_frames() == 0) throw BadInput(path, "it has no frame");
    if (!database_) {
      FragmentDatabase::create(arguments_.database, motion.shared_skeleton(), motion.frame_rate());
      open();
    }
    check_same_skeleton(path, motion.skeleton(), arguments_.database, *database_->skeleton());
    const auto cuts = naming_the_file(path, [&] { return effort::suggest_cuts(motion, arguments_.cuts); });
    FragmentDatabase::Transaction transaction(*database_);
    if (there) naming_the_file(path, [&] { database_->remove_clip(there->id, on_labels(arguments_)); });
    database_->add_clip({name, found_in(path, performer_), found_in(path, action_)}, motion, cuts,
                        effort::CutSource::kSuggested, &diagnostics_);
    transaction.commit();
    ++added_;
  }

  [[nodiscard]] FragmentDatabase& database() {
    if (!database_) open();
    return *database_;
  }
  [[nodiscard]] int added() const { return added_; }
  [[nodiscard]] int skipped() const { return skipped_; }

 private:
  void open() { database_ = FragmentDatabase::open(arguments_.database, effort::Access::kReadWrite); }

  const SegmentArguments& arguments_;
  Diagnostics& diagnostics_;
  std::optional<std::regex> performer_, action_;
  std::optional<FragmentDatabase> database_;
  int added_ = 0, skipped_ = 0;
};

void print_summary(const FragmentDatabase& database) {
  const auto counts = database.counts();
  long long frames = 0;
  for (const auto& fragment : database.fragments()) frames += fragment.frames.num_frames();
  fmt::print("{}: {} clips, {:.1f} s; {} fragments, {:.1f} s of them\n", database.path(), counts.clips,
             static_cast<double>(counts.frames) / database.frame_rate(), counts.fragments,
             static_cast<double>(frames) / database.frame_rate());
}

void run(const SegmentArguments& arguments) {
  if (!arguments.cuts_out.empty()) {
    check_output(arguments.cuts_out, {arguments.database}, overwrite_if(arguments.force));
  }
  PrintedDiagnostics diagnostics;
  Segmenter segmenter(arguments, diagnostics);
  {
    ProgressLine line("segmenting");
    int done = 0;
    for (const std::string& path : arguments.clips) {
      line.update(path, done++, static_cast<int>(arguments.clips.size()));
      segmenter.add(path);
    }
  }
  FragmentDatabase& database = segmenter.database();
  if (segmenter.added() > 0) fmt::print("{} clips added\n", segmenter.added());
  if (segmenter.skipped() > 0) {
    fmt::print("{} clips were there already; --replace cuts them anew\n", segmenter.skipped());
  }
  if (!arguments.cuts_in.empty()) {
    fmt::print("{} clips cut as {} says\n", effort::import_cuts(database, arguments.cuts_in, on_labels(arguments)),
               arguments.cuts_in);
  }
  if (!arguments.cuts_out.empty()) {
    write_file(arguments.cuts_out, effort::format_cuts(database), overwrite_if(arguments.force));
    fmt::print("written {}\n", arguments.cuts_out);
  }
  print_summary(database);
  fmt::print("next: strut effort match {}\n", arguments.database);
}

}  // namespace

void add_effort_segment(CLI::App& app) {
  auto arguments = std::make_shared<SegmentArguments>();
  CLI::App* command = app.add_subcommand("segment", "Cut clips into fragments of movement, into a database");
  command->add_option("database", arguments->database, "Database to make or to add to")->required();
  command->add_option("clips", arguments->clips, "Clips of one skeleton (BVH)");
  command->add_option("--export", arguments->cuts_out, "Write the cuts as a table (CSV) to be edited");
  command->add_option("--import", arguments->cuts_in, "Cut as an edited table says; what stays keeps its labels");
  command->add_option("--performer", arguments->performer,
                      "Regular expression that finds in a file's name who moves (its first group)");
  command->add_option("--action", arguments->action, "The same for what is done");
  command->add_option("--shortest", arguments->cuts.min_duration, "No suggested fragment is shorter, in seconds")
      ->check(number_in(0.1, 10.0))
      ->capture_default_str();
  command->add_option("--longest", arguments->cuts.max_duration, "Longer ones are cut where they are slowest")
      ->check(number_in(0.2, 100.0))
      ->capture_default_str();
  command->add_flag("--replace", arguments->replace, "Read and cut clips again that are there already");
  command->add_flag("--discard-labels", arguments->discard_labels, "Let labels of fragments go that are cut away");
  command->add_flag("--force", arguments->force, "Overwrite an existing table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
