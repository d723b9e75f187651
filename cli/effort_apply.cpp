// SPDX-License-Identifier: MIT
// strut effort apply: puts an Effort on a clip: what is like the model's fragments is replaced by blends of them that
// show what the sliders say.
#include "bvh_options.h"
#include "effort_apply_report.h"
#include "effort_commands.h"
#include "effort_keys.h"
#include "feet_options.h"
#include "input_files.h"
#include "terminal.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/effort/effort_model_io.h>
#include <strut/effort/effort_synthesis.h>
#include <strut/io/bvh.h>

namespace strut::cli {
namespace {

constexpr const char* kTelling =
    "The clip is cut into snippets that are like the model's fragments; each is replaced by the blend of two fragments "
    "that comes nearest to what is wanted. What is like none of them is kept as it is. A table of keys has the columns "
    "time_s and one or more of flow, weight and time; between its rows values change smoothly, and each snippet gets "
    "what is wanted at its middle.";

struct ApplyArguments {
  std::string model, clip, output, report, weights = "equal";
  EffortSliders sliders;
  BvhReadOptions read;
  effort::ApplyOptions options;
  bool force = false;
};

void check_outputs(const ApplyArguments& arguments) {
  std::vector<std::string> inputs{arguments.model, arguments.clip};
  if (!arguments.sliders.keys.empty()) inputs.push_back(arguments.sliders.keys);
  check_output(arguments.output, inputs, overwrite_if(arguments.force));
  if (arguments.report.empty()) return;
  inputs.push_back(arguments.output);
  check_output(arguments.report, inputs, overwrite_if(arguments.force));
}

/// Channels that hold every joint's rotation and the root's travel.
BvhLayout layout_for(const BvhClip& clip) {
  return default_layout(clip.motion.skeleton(), clip.layout.unit, clip.layout.up);
}

void run(const ApplyArguments& arguments) {
  effort::ApplyOptions options = arguments.options;
  options.choice.weights = parse_effort_weights(arguments.weights);
  check_outputs(arguments);
  const effort::EffortCurve wanted = effort_wanted(arguments.sliders);
  PrintedDiagnostics diagnostics;
  const auto model = effort::read_effort_model(arguments.model);
  const BvhClip clip = read_bvh(arguments.clip, arguments.read, &diagnostics);
  const BvhLayout layout = layout_for(clip);
  options.footskate.max_stretch = 0.0;  // the layout holds no stretched bones
  const effort::BlendChooser chooser(model);
  const effort::AppliedEffort applied = naming_the_file(arguments.clip, [&] {
    try {
      return effort::apply_effort(chooser, clip.motion, wanted, options, &diagnostics);
    } catch (const SkeletonMismatch& error) {
      refuse_clip(arguments.clip, error);
    }
  });
  if (applied.coverage == 0.0) {
    throw BadInput(arguments.clip, "nothing in it is like any fragment of " + arguments.model,
                   "add clips of such movement to the database (strut effort segment, match, learn)");
  }
  write_bvh(arguments.output, applied.motion, layout, overwrite_if(arguments.force), &diagnostics);
  if (!arguments.report.empty()) {
    write_file(arguments.report, format_applied(arguments.report, applied, clip.motion.frame_rate(), *model),
               overwrite_if(arguments.force));
  }
  print_applied(arguments.output, applied, clip.motion.frame_rate(), *model);
}

}  // namespace

void add_effort_apply(CLI::App& app) {
  auto arguments = std::make_shared<ApplyArguments>();
  CLI::App* command = app.add_subcommand("apply", "Put an Effort on a clip");
  command->footer(kTelling);
  command->add_option("model", arguments->model, "Effort model (.struteffort), made by strut effort learn")->required();
  command->add_option("clip", arguments->clip, "BVH clip")->required();
  command->add_option("-o,--output", arguments->output, "BVH file to write")->required();
  add_effort_sliders(*command, arguments->sliders);
  command
      ->add_option("--weights", arguments->weights,
                   "What an error in each factor counts: equal, noticed (what viewers notice: 0.8,0.15,1) or "
                   "FLOW,WEIGHT,TIME")
      ->type_name("WEIGHTS")
      ->capture_default_str();
  command->add_option("--report", arguments->report,
                      "File to write the snippets to: CSV, or JSON if its name ends in .json");
  command->add_flag_callback(
      "--no-clean-feet", [arguments] { arguments->options.clean_feet = false; },
      "Leave feet as the blends move them instead of holding planted ones");
  add_bvh_read_options(*command, "--", arguments->read);
  command->add_flag("--force", arguments->force, "Overwrite existing files");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
