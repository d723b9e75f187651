// SPDX-License-Identifier: MIT
// strut translate: puts a learnt style on a clip.
#include "commands.h"
#include "feet_options.h"
#include "input_files.h"
#include "style_options.h"
#include "terminal.h"
#include "usage.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/translate/translate_motion.h>

namespace strut::cli {
namespace {

struct TranslateArguments {
  StyleArguments style;
  std::string clip, output;
  bool retime = true, clean_feet = true;
  double warm_up = TranslateOptions{}.warm_up;
  bool keep_layout = false, force = false;
};

/// A mismatch is the clip's fault in the person's eyes: say which file.
[[noreturn]] void name_the_clip(const std::string& clip, const SkeletonMismatch& error) {
  throw SkeletonMismatch(clip + ": error: " + error.what(),
                         "translate motion of the character the style was learnt on");
}

void run(const TranslateArguments& arguments) {
  std::vector<std::string> inputs = arguments.style.paths();
  inputs.push_back(arguments.clip);
  check_output(arguments.output, inputs, overwrite_if(arguments.force));
  PrintedDiagnostics diagnostics;
  const auto models = read_models(arguments.style);
  const BvhClip clip = read_bvh(arguments.clip, {}, &diagnostics);
  const BvhLayout layout =
      arguments.keep_layout ? clip.layout : default_layout(clip.motion.skeleton(), clip.layout.unit, clip.layout.up);
  TranslateOptions options{.controls = arguments.style.controls,
                           .generalization = arguments.style.generalization,
                           .retime = arguments.retime,
                           .clean_feet = arguments.clean_feet,
                           .warm_up = arguments.warm_up};
  const auto legs = motion::find_legs(clip.motion);
  if (!legs || !holds_stretch(layout, *legs)) options.footskate.max_stretch = 0.0;
  try {
    const Motion result =
        naming_the_file(arguments.clip, [&] { return translate_motion(models, clip.motion, options, &diagnostics); });
    write_bvh(arguments.output, result, layout, overwrite_if(arguments.force), &diagnostics);
    fmt::print("{}: {} frames, {:.2f} s (input {:.2f} s)\n", arguments.output, result.num_frames(), result.duration(),
               clip.motion.duration());
  } catch (const SkeletonMismatch& error) {
    name_the_clip(arguments.clip, error);
  }
}

}  // namespace

void add_translate(CLI::App& app) {
  auto arguments = std::make_shared<TranslateArguments>();
  CLI::App* command = app.add_subcommand("translate", "Put a learnt style on a clip");
  add_style_options(*command, arguments->style);
  command->add_option("clip", arguments->clip, "BVH clip in the model's input style")->required();
  command->add_option("-o,--output", arguments->output, "BVH file to write")->required();
  command->add_flag_callback(
      "--no-retime", [arguments] { arguments->retime = false; }, "Keep the input's timing, frame for frame");
  command->add_flag_callback(
      "--no-clean-feet", [arguments] { arguments->clean_feet = false; }, "Let planted feet slide as they come out");
  command->add_option("--warm-up", arguments->warm_up, "Seconds of motion extrapolated before the clip, 0 for none")
      ->check(number_in(0.0, 60.0))
      ->capture_default_str();
  command->add_flag("--keep-layout", arguments->keep_layout,
                    "Write the input file's channels instead of six on the root, three elsewhere");
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
