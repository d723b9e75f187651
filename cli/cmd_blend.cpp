// SPDX-License-Identifier: MIT
// strut blend: learns how several styles walk at several speeds, and makes endless walks of any mixture at any speed.
#include "blend_arguments.h"
#include "blend_report.h"
#include "bvh_options.h"
#include "commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/blend/gait_model_io.h>
#include <strut/blend/learn_gaits.h>
#include <strut/blend/locomotion.h>
#include <strut/core/error.h>
#include <strut/core/version.h>
#include <strut/io/bvh.h>

namespace strut::cli {
namespace {

constexpr const char* kForms =
    "Three forms:\n"
    "  strut blend gaits.strutgait --learn old= old_*.bvh brisk= brisk_*.bvh   learn from clips of each style\n"
    "  strut blend gaits.strutgait                                            show what was learnt\n"
    "  strut blend gaits.strutgait --style old=0.5 --style brisk=0.5 --speed 1.2 --seconds 20 -o out.bvh\n"
    "Weights sum to 1; below 0 or above 1 they exaggerate. A table of keys has the columns time_s, speed_m_per_s, one "
    "per "
    "style with its weight, and turn_rate_rad_per_s if you like; between its rows all change smoothly.";

struct BlendArguments {
  std::string model;
  std::vector<std::string> learn;
  bool is_symmetric = false, is_asymmetric = false;
  blend::GaitExampleOptions examples;
  BvhReadOptions read;
  std::string output, keys;
  std::vector<std::string> styles;
  std::optional<double> speed, turn_rate, seconds;
  bool cycle = false;
  blend::SynthesisOptions synthesis;
  bool force = false;
};

std::vector<blend::StyledClip> read_clips(const std::vector<StyleClips>& styles, const BvhReadOptions& options,
                                          Diagnostics& diagnostics) {
  std::vector<blend::StyledClip> clips;
  for (const StyleClips& style : styles) {
    for (const std::string& path : style.paths) {
      clips.push_back({style.style, read_bvh(path, options, &diagnostics).motion, path});
      check_same_skeleton(path, clips.back().motion.skeleton(), clips.front().name, clips.front().motion.skeleton());
    }
  }
  return clips;
}

std::string provenance_of(const BlendArguments& arguments, const std::vector<StyleClips>& styles,
                          const std::vector<std::string>& names, const blend::GaitReport& report) {
  nlohmann::ordered_json all = {{"strut", version()}, {"clips", nlohmann::ordered_json::object()}};
  for (const StyleClips& style : styles) all["clips"][style.style] = style.paths;
  all["options"] = {{"model", arguments.is_symmetric ? "symmetric" : "asymmetric"},
                    {"harmonics", arguments.examples.harmonics},
                    {"most_turning_rad", arguments.examples.most_turning},
                    {"speed_bin", arguments.examples.speed_bin}};
  all["report"] = gait_report_as_json(report, names);
  // A file's name may be in any encoding.
  return all.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void learn(const BlendArguments& arguments) {
  const std::vector<StyleClips> styles = parse_style_clips(arguments.learn);
  std::vector<std::string> inputs;
  for (const StyleClips& style : styles) inputs.insert(inputs.end(), style.paths.begin(), style.paths.end());
  check_output(arguments.model, inputs, overwrite_if(arguments.force));
  if (styles.size() < 2) {
    throw CLI::ValidationError("--learn", "expected clips of two styles or more, got one: there is nothing to blend");
  }
  PrintedDiagnostics diagnostics;
  const std::vector<blend::StyledClip> clips = read_clips(styles, arguments.read, diagnostics);
  blend::GaitLearnOptions options;
  if (arguments.is_symmetric) options.kind = blend::BilinearKind::kSymmetric;
  blend::LearntGaits learnt;
  {
    ProgressLine line("learning");
    line.update("gait cycles", 0, 2);
    const blend::GaitExamples examples = blend::gait_examples(clips, arguments.examples, &diagnostics);
    line.update("bilinear model", 1, 2);
    learnt = blend::learn_gaits(
        examples, options,
        [&](const blend::GaitReport& report) { return provenance_of(arguments, styles, examples.styles, report); },
        &diagnostics);
  }
  blend::write_gait_model(arguments.model, *learnt.model, overwrite_if(arguments.force));
  print_gait_model(arguments.model, *learnt.model);
}

std::vector<blend::GaitKey> keys_of(const BlendArguments& arguments, const blend::GaitModel& model) {
  if (!arguments.keys.empty()) return read_gait_keys(arguments.keys, model);
  if (arguments.styles.empty() || !arguments.speed) {
    throw CLI::ValidationError(std::string(arguments.styles.empty() ? "--style" : "--speed") +
                               " is missing: what is to be made (or --keys, a table of both over time)");
  }
  return {{0.0,
           {parse_style_weights(arguments.styles, model, arguments.model), *arguments.speed,
            arguments.turn_rate.value_or(0.0)}}};
}

void make(const BlendArguments& arguments) {
  std::vector<std::string> inputs{arguments.model};
  if (!arguments.keys.empty()) inputs.push_back(arguments.keys);
  check_output(arguments.output, inputs, overwrite_if(arguments.force));
  PrintedDiagnostics diagnostics;
  const auto model = blend::read_gait_model(arguments.model);
  const std::vector<blend::GaitKey> keys = keys_of(arguments, *model);
  const double seconds = arguments.seconds.value_or(keys.size() > 1 ? keys.back().time : 10.0);
  blend::SynthesisOptions options = arguments.synthesis;
  options.footskate.max_stretch = 0.0;  // the default layout holds no stretched bones
  const blend::SynthesizedGait gait = arguments.cycle
                                          ? blend::synthesize_cycle(model, keys.front().controls, options, &diagnostics)
                                          : blend::synthesize(model, keys, seconds, options, &diagnostics);
  write_bvh(arguments.output, gait.motion, default_layout(gait.motion.skeleton()), overwrite_if(arguments.force),
            &diagnostics);
  fmt::print("{}: {} frames, {:.2f} s, {} footplants{}\n", arguments.output, gait.motion.num_frames(),
             gait.motion.duration(), gait.footplants.size(), arguments.cycle ? ", loops" : "");
}

void run(const BlendArguments& arguments) {
  if (!arguments.learn.empty()) {
    learn(arguments);
  } else if (!arguments.output.empty()) {
    make(arguments);
  } else if (!arguments.styles.empty() || !arguments.keys.empty()) {
    throw CLI::ValidationError("--output is missing: BVH file to write");
  } else {
    print_gait_model(arguments.model, *blend::read_gait_model(arguments.model));
  }
}

void add_learn_options(CLI::App& command, BlendArguments& arguments) {
  CLI::Option* learn =
      command
          .add_option("--learn", arguments.learn,
                      "Learn the model: STYLE= and the BVH clips of that style, then the next style; all walk straight")
          ->type_name("STYLE= CLIP...");
  CLI::Option* symmetric = command.add_flag("--symmetric", arguments.is_symmetric,
                                            "A vector per style on shared functions, for many styles with few speeds");
  command.add_flag("--asymmetric", arguments.is_asymmetric, "A matrix per style (default)")
      ->excludes(symmetric)
      ->needs(learn);
  symmetric->needs(learn);
  command.add_option("--harmonics", arguments.examples.harmonics, "Of the gait cycle that are kept when learning")
      ->check(number_in(1, 30))
      ->capture_default_str();
  command
      .add_option("--speed-bin", arguments.examples.speed_bin,
                  "Cycles of a style whose speeds differ by less than this share are averaged")
      ->check(number_in(0.001, 1.0))
      ->capture_default_str();
  add_bvh_read_options(command, "--", arguments.read);
  for (const char* made : {"--output", "--style", "--speed", "--turn-rate", "--keys", "--seconds", "--cycle",
                           "--frame-rate", "--no-clean-feet"}) {
    learn->excludes(command.get_option(made));
  }
  for (const char* learnt : {"--harmonics", "--speed-bin"}) command.get_option(learnt)->needs(learn);
}

void add_make_options(CLI::App& command, BlendArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "BVH file to make");
  CLI::Option* style =
      command.add_option("--style", arguments.styles, "A style and its weight; weights sum to 1; repeatable");
  style->allow_extra_args(false)->type_name("STYLE=WEIGHT");
  CLI::Option* speed =
      command.add_option("--speed", arguments.speed, "In metres per second")->check(number_in(1e-3, 20.0));
  CLI::Option* turn = command.add_option("--turn-rate", arguments.turn_rate, "To the left, in radians per second")
                          ->check(number_in(-2.0, 2.0));
  command.add_option("--keys", arguments.keys, "Table of styles, speeds and turning over time, instead of these three")
      ->type_name("TABLE")
      ->excludes(style)
      ->excludes(speed)
      ->excludes(turn);
  CLI::Option* seconds =
      command.add_option("--seconds", arguments.seconds, "How long (default: to the last key, else 10)")
          ->check(number_in(0.1, 36000.0));
  command.add_flag("--cycle", arguments.cycle, "Make one cycle that loops")
      ->excludes(seconds)
      ->excludes(turn)
      ->excludes("--keys");
  command
      .add_option("--frame-rate", arguments.synthesis.frame_rate,
                  "Frames per second of what is made; 0: as in the examples")
      ->check(number_in(0.0, 1000.0))
      ->capture_default_str();
  command.add_flag_callback(
      "--no-clean-feet", [&arguments] { arguments.synthesis.clean_feet = false; },
      "Leave feet as the model moves them instead of holding planted ones");
}

}  // namespace

void add_blend(CLI::App& app) {
  auto arguments = std::make_shared<BlendArguments>();
  CLI::App* command =
      app.add_subcommand("blend", "Learn how styles walk at many speeds, and make walks of any mixture at any speed");
  command->footer(kForms);
  command->add_option("model", arguments->model, "Gait model (.strutgait): written with --learn, else read")
      ->required();
  add_make_options(*command, *arguments);
  add_learn_options(*command, *arguments);
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
