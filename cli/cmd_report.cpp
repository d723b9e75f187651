// SPDX-License-Identifier: MIT
// strut report: one HTML file with clips, their curves and figures, to send to a colleague who has nothing but a
// browser.
#include "commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"
#include "view/report.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/io/bvh.h>

namespace strut::cli {
namespace {

struct ReportArguments {
  std::vector<std::string> clips, names;
  std::string output;
  ReportOptions page;
  bool force = false;
};

/// "a.bvh, b.bvh and 3 others"
std::string title_of(const std::vector<ReportClip>& clips) {
  std::string title = clips.front().name;
  if (clips.size() > 1) title += (clips.size() == 2 ? " and " : ", ") + clips[1].name;
  if (clips.size() > 2) title += fmt::format(" and {} more", clips.size() - 2);
  return title;
}

std::vector<ReportClip> read_clips(const ReportArguments& arguments) {
  std::vector<ReportClip> clips;
  for (std::size_t i = 0; i < arguments.clips.size(); ++i) {
    const std::string& path = arguments.clips[i];
    const std::string name =
        arguments.names.empty() ? std::filesystem::path(path).filename().string() : arguments.names[i];
    Diagnostics notes;
    Motion motion = read_bvh(path, {}, &notes).motion;
    if (motion.num_frames() == 0) throw BadInput(path, "there is no frame in it to show");
    clips.push_back({name, std::move(motion), std::move(notes)});
  }
  return clips;
}

void check(const ReportArguments& arguments) {
  if (!arguments.names.empty() && arguments.names.size() != arguments.clips.size()) {
    throw InvalidArgument("--name", fmt::format("one for each of {} clips", arguments.clips.size()),
                          fmt::format("{}", arguments.names.size()), "give --name once per clip, in their order");
  }
  check_output(arguments.output, arguments.clips, overwrite_if(arguments.force));
}

void run(const ReportArguments& arguments) {
  check(arguments);
  const auto clips = read_clips(arguments);
  ReportOptions options = arguments.page;
  if (options.title.empty()) options.title = title_of(clips);
  const std::string page = report_page(clips, options);
  write_file(arguments.output, page, overwrite_if(arguments.force));
  fmt::print("{}: {:.1f} MB. Open it in a browser; it needs neither strut nor a network.\n", arguments.output,
             static_cast<double>(page.size()) * 1e-6);
}

}  // namespace

void add_report(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "report", "Write clips, their curves and figures to one HTML file that opens in any browser, to be sent on");
  const auto arguments = std::make_shared<ReportArguments>();
  command->add_option("clips", arguments->clips, "BVH files; the others are aligned with the first")
      ->required()
      ->type_name("CLIP");
  command->add_option("-o,--output", arguments->output, "The report to write (HTML)")->required()->type_name("FILE");
  command->add_option("--title", arguments->page.title, "What the report is called (default: the clips' names)");
  command->add_option("--note", arguments->page.notes, "A paragraph on top of the report; may be given several times")
      ->allow_extra_args(false);
  command
      ->add_option("--name", arguments->names,
                   "What a clip is called; once per clip, in their order (default: its file)")
      ->allow_extra_args(false);
  command->add_flag("--no-align{false}", arguments->page.align,
                    "Leave out the alignments with the first clip, by which the page plays the same phase at once "
                    "(default: with every clip that has its skeleton)");
  command
      ->add_option(
          "--curves", arguments->page.curves,
          "Which curves the report holds: all, body (those of the body as a whole), or fitting (default; all unless "
          "they take more than 8 MB, else body)")
      ->transform(one_of({{"fitting", static_cast<int>(ReportCurves::kFitting)},
                          {"body", static_cast<int>(ReportCurves::kBody)},
                          {"all", static_cast<int>(ReportCurves::kAll)}})
                      .description(""))
      ->type_name("fitting|body|all");
  command->add_flag("--force", arguments->force, "Overwrite the report if it is there (default: refuse)");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
