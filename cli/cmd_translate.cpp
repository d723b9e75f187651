// SPDX-License-Identifier: MIT
// strut translate: puts a learnt style on a clip, or on motion as it comes.
#include "bvh_options.h"
#include "commands.h"
#include "input_files.h"
#include "style_options.h"
#include "terminal.h"
#include "translate_stream.h"
#include "translated_clip.h"
#include "usage.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/io/bvh.h>
#include <strut/translate/translate_motion.h>

namespace strut::cli {
namespace {

constexpr const char* kOfStreams =
    "With --stream or --follow every row of BVH that comes in goes out translated at once, until the input ends, an "
    "interrupt comes or nobody reads the output any more (exit code 0). The style's timing is left out: a style that "
    "moves faster would need motion that has not been performed yet, one that moves slower would fall ever further "
    "behind the performer.";

struct TranslateArguments {
  StyleArguments style;
  std::string clip, output;
  BvhReadOptions read;
  bool retime = true, clean_feet = true, clean_stream = false;
  double warm_up = TranslateOptions{}.warm_up;
  bool keep_layout = false, force = false;
  bool streams = false;
  std::string followed;
  std::optional<double> idle;
};

void translate_clip(const TranslateArguments& arguments) {
  std::vector<std::string> inputs = arguments.style.paths();
  inputs.push_back(arguments.clip);
  check_output(arguments.output, inputs, overwrite_if(arguments.force));
  PrintedDiagnostics diagnostics;
  const auto models = read_models(arguments.style);
  const BvhClip clip = read_bvh(arguments.clip, arguments.read, &diagnostics);
  const TranslateOptions options{.controls = arguments.style.controls,
                                 .generalization = arguments.style.generalization,
                                 .retime = arguments.retime,
                                 .clean_feet = arguments.clean_feet,
                                 .warm_up = arguments.warm_up};
  const TranslatedClip translated =
      translate_file(arguments.clip, clip, models, options, arguments.keep_layout, &diagnostics);
  const Motion& result = translated.translation.motion;
  write_bvh(arguments.output, result, translated.layout, overwrite_if(arguments.force), &diagnostics);
  fmt::print("{}: {} frames, {:.2f} s (input {:.2f} s)\n", arguments.output, result.num_frames(), result.duration(),
             clip.motion.duration());
}

void run(const TranslateArguments& arguments) {
  const bool is_followed = !arguments.followed.empty();
  if (arguments.streams || is_followed) {
    StreamArguments stream{.is_followed = is_followed,
                           .idle = arguments.idle,
                           .read = arguments.read,
                           .clean_feet = arguments.clean_stream,
                           .keep_layout = arguments.keep_layout,
                           .force = arguments.force};
    const std::string& input = is_followed ? arguments.followed : arguments.clip;
    if (!input.empty()) stream.input = input;
    if (!arguments.output.empty()) stream.output = arguments.output;
    translate_stream(arguments.style, stream);
    return;
  }
  const char* missing = arguments.clip.empty() ? "clip is missing: BVH clip in the model's input style"
                                               : "--output is missing: BVH file to write";
  if (arguments.clip.empty() || arguments.output.empty()) {
    throw CLI::ValidationError(std::string(missing) + " (neither is needed with --stream)");
  }
  translate_clip(arguments);
}

void add_stream_options(CLI::App& command, TranslateArguments& arguments, CLI::Option* clip,
                        const std::vector<CLI::Option*>& of_whole_clips) {
  CLI::Option* stream = command.add_flag(
      "--stream", arguments.streams,
      "Translate row by row, from standard input (or the clip) to standard output (or --output), no row later than it "
      "comes; the model's frame rate must be the input's");
  CLI::Option* follow =
      command.add_option("--follow", arguments.followed, "Stream from a BVH file that is being written")
          ->type_name("FILE")
          ->excludes(clip);
  command
      .add_option("--until-idle", arguments.idle,
                  "With --follow: end when the file has not grown for so many seconds (default: only when interrupted, "
                  "or when all frames that its header claims are there)")
      ->check(number_in(0.0, 1e6))
      ->needs(follow);
  command.add_flag("--clean-feet", arguments.clean_stream,
                   "In a stream: hold planted feet; rows then come out 0.3 s later than they go in");
  for (CLI::Option* option : of_whole_clips) option->excludes(stream)->excludes(follow);
}

}  // namespace

void add_translate(CLI::App& app) {
  auto arguments = std::make_shared<TranslateArguments>();
  CLI::App* command = app.add_subcommand("translate", "Put a learnt style on a clip, or on motion as it comes");
  command->footer(kOfStreams);
  add_style_options(*command, arguments->style);
  CLI::Option* clip = command->add_option("clip", arguments->clip, "BVH clip in the model's input style");
  command->add_option("-o,--output", arguments->output,
                      "BVH file to write; in a stream it grows row by row (default there: standard output)");
  command->add_flag_callback(
      "--no-retime", [arguments] { arguments->retime = false; }, "Keep the input's timing, frame for frame");
  CLI::Option* no_clean_feet = command->add_flag_callback(
      "--no-clean-feet", [arguments] { arguments->clean_feet = false; },
      "Leave the feet of a whole clip as the model moves them instead of holding planted ones");
  CLI::Option* warm_up = command
                             ->add_option("--warm-up", arguments->warm_up,
                                          "Seconds of motion extrapolated before a whole clip, 0 for none")
                             ->check(number_in(0.0, kLongestWarmUp))
                             ->capture_default_str();
  add_stream_options(*command, *arguments, clip, {warm_up, no_clean_feet});
  add_bvh_read_options(*command, "--", arguments->read);
  command->add_flag("--keep-layout", arguments->keep_layout,
                    "Write the input file's channels instead of six on the root, three elsewhere");
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
