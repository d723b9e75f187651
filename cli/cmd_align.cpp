// SPDX-License-Identifier: MIT
// strut align: which moment of a clip belongs to which moment of others of the same content, or of all to a common
// timeline, as a report, as tables and as a figure.
#include "align_drawing.h"
#include "align_report.h"
#include "align_signals.h"
#include "alignment.h"
#include "commands.h"
#include "group_alignment.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <strut/align/time_warp.h>
#include <strut/core/error.h>
#include <strut/core/file.h>

namespace strut::cli {
namespace {

constexpr double kStiffest = 1e12;  // far beyond rigid, and squares of it are still numbers

// ---- where results go -----------------------------------------------------------------------------------------------

/// A file to write for every output clip.
class ResultFiles {
 public:
  /// `target`: a file; for several `clips`, or with a slash at its end, a folder in which every clip gets a file of its
  /// own name with `ending`; empty: nothing.
  /// Refuses what cannot be written. `others`: files that must not be overwritten.
  ResultFiles(const std::string& target, const std::vector<std::string>& clips, const std::string& ending,
              const std::vector<std::string>& others, Overwrite overwrite) {
    if (target.empty()) return;
    std::error_code missing;
    const bool is_folder = clips.size() > 1 || target.back() == '/';
    if (is_folder && !std::filesystem::is_directory(target, missing)) {
      throw FileError(FileAction::kWrite, target, "not a folder, which is needed for files of several clips",
                      "make a folder of this name first");
    }
    std::map<std::string, std::string> writers;
    for (const std::string& clip : clips) {
      const std::string stem = std::filesystem::path(clip).stem().string();
      paths_.push_back(is_folder ? (std::filesystem::path(target) / (stem + ending)).string() : target);
      const auto [first, is_new] = writers.try_emplace(paths_.back(), clip);
      if (!is_new) {
        throw FileError(FileAction::kWrite, paths_.back(),
                        "two clips would be written to it: " + first->second + " and " + clip,
                        "align clips of one name apart");
      }
      check_output(paths_.back(), others, overwrite);
    }
  }

  [[nodiscard]] bool is_wanted() const { return !paths_.empty(); }
  [[nodiscard]] const std::vector<std::string>& paths() const { return paths_; }
  void keep(std::string text) { texts_.push_back(std::move(text)); }
  void write(Overwrite overwrite) const {
    for (std::size_t i = 0; i < texts_.size(); ++i) write_file(paths_[i], texts_[i], overwrite);
  }

 private:
  std::vector<std::string> paths_, texts_;
};

std::vector<std::string> with(std::vector<std::string> paths, const std::vector<std::string>& more) {
  paths.insert(paths.end(), more.begin(), more.end());
  return paths;
}

// ---- the work -------------------------------------------------------------------------------------------------------

/// What is printed at the end.
struct Report {
  std::string text;
  nlohmann::ordered_json json;
};

void print(const Report& report, bool as_json) {
  using Json = nlohmann::ordered_json;
  fmt::print("{}", as_json ? report.json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n" : report.text);
}

void run(const AlignOptions& options) {
  const std::vector<std::string> clips = with(options.outputs, {options.input});
  const Overwrite overwrite = overwrite_if(options.force);
  ResultFiles tables(options.csv, options.outputs, ".csv", clips, overwrite);
  ResultFiles inverses(options.inverse_csv, options.outputs, ".inverse.csv", with(clips, tables.paths()), overwrite);
  ResultFiles plots(options.plot, options.outputs, ".svg", with(with(clips, tables.paths()), inverses.paths()),
                    overwrite);
  PrintedDiagnostics diagnostics;
  const AlignClip input = read_align_clip(options.input, diagnostics);
  ProgressLine progress("strut align");
  Report report{clip_in_words("input", input), {{"input", clip_as_json(input)}}};
  for (const std::string& path : options.outputs) {
    progress.update("aligning", static_cast<int>(&path - options.outputs.data()),
                    static_cast<int>(options.outputs.size()));
    const Alignment a = align_clips(input, read_align_clip(path, diagnostics), options, diagnostics);
    if (tables.is_wanted()) tables.keep(alignment_table(a));
    if (inverses.is_wanted()) inverses.keep(inverse_table(a));
    if (plots.is_wanted()) {
      plots.keep(draw_alignment(figure_of(a, options, diagnostics), static_cast<FigurePart>(options.figure)));
    }
    report.text += alignment_in_words(a, options.outputs.size() == 1);
    report.json["alignments"].push_back(alignment_as_json(a));
  }
  for (const ResultFiles* files : {&tables, &inverses, &plots}) files->write(overwrite);
  print(report, options.json);
}

void run_groupwise(const AlignOptions& options) {
  const std::vector<std::string> paths = with({options.input}, options.outputs);
  const Overwrite overwrite = overwrite_if(options.force);
  ResultFiles tables(options.csv, paths, ".csv", paths, overwrite);
  ResultFiles inverses(options.inverse_csv, paths, ".inverse.csv", with(paths, tables.paths()), overwrite);
  PrintedDiagnostics diagnostics;
  std::vector<AlignClip> clips;
  for (const std::string& path : paths) clips.push_back(read_align_clip(path, diagnostics));
  const GroupAlignment group = align_clips_groupwise(std::move(clips), options, diagnostics);
  for (std::size_t k = 0; k < group.clips.size(); ++k) {
    if (tables.is_wanted()) tables.keep(group_table(group, k));
    if (inverses.is_wanted()) inverses.keep(group_inverse_table(group, k));
  }
  for (const ResultFiles* files : {&tables, &inverses}) files->write(overwrite);
  print({group_in_words(group), group_as_json(group)}, options.json);
}

// ---- the options ----------------------------------------------------------------------------------------------------

/// The methods' names to their places in the table, joined for the help, and described.
struct MethodWords {
  std::map<std::string, int> numbers;
  std::string names, descriptions;
  MethodWords() {
    for (const AlignMethod& method : align_methods()) {
      numbers[method.name] = static_cast<int>(numbers.size());
      names += (names.empty() ? "" : "|") + std::string(method.name);
      descriptions += (descriptions.empty() ? "" : "; ") + std::string(method.name) + ": " + method.description;
    }
  }
};

/// "BEGIN,END" to the stretch of time.
Span parse_window(const std::string& word) {
  const auto comma = word.find(',');
  Span span;
  const bool fits = comma != std::string::npos && CLI::detail::lexical_cast(word.substr(0, comma), span.begin) &&
                    CLI::detail::lexical_cast(word.substr(comma + 1), span.end) && span.begin >= 0.0 &&
                    span.end > span.begin && span.end < 1e9;
  if (!fits) throw CLI::ValidationError("--window", "expected two times in seconds, BEGIN,END, got '" + word + "'");
  return span;
}

/// A name that promises another kind of picture would disappoint.
CLI::Validator draws_svg() {
  return {[](std::string& path) {
            const std::string ending = CLI::detail::to_lower(std::filesystem::path(path).extension().string());
            const std::vector<std::string> others{".png", ".pdf", ".eps", ".ps", ".jpg", ".jpeg", ".tif", ".tiff"};
            const bool is_other = std::find(others.begin(), others.end(), ending) != others.end();
            return is_other ? "expected a name in .svg, which is what is drawn, got '" + path + "'" : std::string();
          },
          ""};
}

void add_method_options(CLI::App& command, AlignOptions& options) {
  const MethodWords methods;
  command
      .add_option("--method", options.method,
                  fmt::format("{} (default: {}; {} if the ends are open)", methods.descriptions,
                              default_method(align::Ends::kFixed).name, default_method(align::Ends::kOpen).name))
      ->transform(one_of(methods.numbers).description(""))
      ->type_name(methods.names);
  command
      .add_option("--signals", options.signals,
                  "What is compared: all: posture, how it changes, and how still the feet are; posture: the paper's "
                  "(default: all for continuous, posture for the others)")
      ->transform(one_of({{signals_name(SignalSet::kPosture), static_cast<int>(SignalSet::kPosture)},
                          {signals_name(SignalSet::kAll), static_cast<int>(SignalSet::kAll)}})
                      .description(""))
      ->type_name("posture|all");
  command
      .add_option("--slope-limit", options.settings.slope_limit,
                  "An input frame covers at most this many output frames and at least one over it, e.g. 1.5; not for "
                  "dtw1 and dtw3 (default: 3 for continuous, 2 for the others)")
      ->check(number_in(1, align::kLargestSlopeLimit).description(""))
      ->type_name("X");
  command
      .add_option(
          "--resolution", options.settings.time.resolution,
          "Parts of an output frame that imw and timewarp tell apart; finer is slower and less jagged (default: "
          "the slope limit, or what it takes to come near it)")
      ->check(number_in(1, align::kLargestResolution).description(""))
      ->type_name("N");
  command
      .add_option("--ends", options.settings.time.ends,
                  "Whether the input must begin and end where the output does, or may anywhere in it, as a short clip "
                  "inside a long one; imw and timewarp (default: fixed)")
      ->transform(one_of({{"fixed", static_cast<int>(align::Ends::kFixed)},
                          {"open-begin", static_cast<int>(align::Ends::kOpenBegin)},
                          {"open-end", static_cast<int>(align::Ends::kOpenEnd)},
                          {"open", static_cast<int>(align::Ends::kOpen)}})
                      .description(""))
      ->type_name("fixed|open-begin|open-end|open");
  command
      .add_option("--smoothness", options.settings.smoothness,
                  "Stiffness of imw's spatial warp, for signals of unit variance (default: 100)")
      ->check(number_in(0, kStiffest).description(""))
      ->type_name("X");
  command.add_option("--rounds", options.settings.rounds, "At most this many rounds of imw (default: 10)")
      ->check(number_in(1, 1000).description(""))
      ->type_name("N");
  command
      .add_option("--warp-smoothness", options.warp_smoothness,
                  "Smoothing of the differential warp in the last column of the table [frames^2]; 0: none "
                  "(default: 10, 0 for continuous)")
      ->check(number_in(0, kStiffest).description(""))
      ->type_name("X");
  command.add_flag(
      "--shared-units", options.shared_units,
      "With --signals posture: compare postures as they are, about one mean and in one unit for both clips "
      "(default: each clip about its own mean in its own standard deviation, as strut learn does)");
  command
      .add_option("--weight", options.weights,
                  "How much a joint, or a degree of freedom of it, counts: e.g. LeftUpLeg=2, or 0 to leave it out; "
                  "feet: how still they are; may be given several times (default: 1 each)")
      ->allow_extra_args(false)
      ->type_name("NAME=X");
}

void add_result_options(CLI::App& command, AlignOptions& options) {
  command
      .add_option(
          "--csv", options.csv,
          "Write a table: frame, time [s], output frame, output time [s], differential warp, the same smoothed; "
          "for several outputs into this folder, one for each (default: none)")
      ->type_name("FILE");
  command
      .add_option("--inverse-csv", options.inverse_csv,
                  "Write the same the other way around, a row per output frame: its place in the input (default: none)")
      ->type_name("FILE");
  CLI::Option* plot =
      command
          .add_option(
              "--plot", options.plot,
              "Draw an SVG: curves before and after, the distances of all frames with the path, the warp and its "
              "slope, the footplants of both clips; for several outputs into this folder (default: none)")
          ->check(draws_svg())
          ->type_name("FILE");
  command.add_option("--figure", options.figure, "What of it is drawn (default: all)")
      ->transform(one_of({{"all", static_cast<int>(FigurePart::kAll)},
                          {"curves", static_cast<int>(FigurePart::kCurves)},
                          {"matrix", static_cast<int>(FigurePart::kMatrix)},
                          {"warp", static_cast<int>(FigurePart::kWarp)},
                          {"footplants", static_cast<int>(FigurePart::kFootplants)}})
                      .description(""))
      ->needs(plot)
      ->type_name("all|curves|matrix|warp|footplants");
  command
      .add_option("--dof", options.dof,
                  "The degree of freedom whose curves are drawn, e.g. 'LeftUpLeg x', or a joint's name (default: the "
                  "joint angle that moves most)")
      ->needs(plot)
      ->type_name("NAME");
  command
      .add_option_function<std::string>(
          "--window", [&options](const std::string& word) { options.window = parse_window(word); },
          "Draw this part of the input only, in seconds (default: all; of long clips the first 12 s, but for the "
          "warp)")
      ->needs(plot)
      ->type_name("BEGIN,END");
}

}  // namespace

void add_align(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("align", "Find which moment of a clip belongs to which moment of others of the same content");
  const auto options = std::make_shared<AlignOptions>();
  command->add_option("input", options->input, "BVH file: the clip whose frames are given places")
      ->required()
      ->type_name("INPUT");
  command
      ->add_option("output", options->outputs,
                   "BVH files of the same hierarchy: the clips in whose time they are placed, each by itself; with "
                   "--groupwise the others of the group")
      ->required()
      ->type_name("OUTPUT");
  command->add_flag(
      "--groupwise", options->groupwise,
      "Align all clips, INPUT among them, with a common timeline that none of them sets; --csv and "
      "--inverse-csv then name folders for a table of each clip: timeline frame, time [s], clip frame, clip "
      "time [s], differential warp; not with --plot (default: each OUTPUT by itself)");
  add_method_options(*command, *options);
  add_result_options(*command, *options);
  add_feet_option(*command, options->feet);
  command->add_flag("--json", options->json, "Print JSON, times in seconds (default: text)");
  command->add_flag("--force", options->force, "Overwrite files that exist (default: refuse)");
  command->callback([options] { options->groupwise ? run_groupwise(*options) : run(*options); });
}

}  // namespace strut::cli
