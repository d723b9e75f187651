// SPDX-License-Identifier: MIT
// strut effort blend: a movement between two of like content, or beyond one of them, in posture, timing and travel.
#include "bvh_options.h"
#include "effort_commands.h"
#include "feet_options.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <strut/align/time_warp.h>
#include <strut/core/error.h>
#include <strut/effort/effort.h>
#include <strut/effort/space_time_blend.h>
#include <strut/io/bvh.h>
#include <strut/metrics/foot_slide.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footskate.h>

namespace strut::cli {
namespace {

constexpr double kCmPerMetre = 100.0;

struct EffortBlendArguments {
  std::string first, second, output;
  double alpha = 0.0;
  effort::SpaceTimeBlendOptions blend;
  BvhReadOptions read;
  bool clean_feet = true, force = false;
};

/// The second fragment, at the first's frame rate.
Motion read_second(const EffortBlendArguments& arguments, const Motion& first, Diagnostics& diagnostics) {
  Motion second = read_bvh(arguments.second, arguments.read, &diagnostics).motion;
  check_same_skeleton(arguments.second, second.skeleton(), arguments.first, first.skeleton());
  if (second.frame_rate() == first.frame_rate() || second.num_frames() == 0) return second;
  diagnostics.note(arguments.second, fmt::format("resampled from {:g} to {:g} frames/s, the rate of {}",
                                                 second.frame_rate(), first.frame_rate(), arguments.first));
  return motion::resample(second, first.frame_rate());
}

effort::SpaceTimeBlend blend_of(const EffortBlendArguments& arguments, const Motion& first, const Motion& second) {
  try {
    return {first, second, arguments.blend};
  } catch (const InvalidArgument& error) {
    // The argument's name means something to a programmer only.
    throw BadInput(error.argument() == "first" ? arguments.first : arguments.second,
                   std::string(error.what()).substr(error.argument().size() + 2), error.hint());
  }
}

double slide(const Motion& motion, const std::vector<motion::Footplant>& plants) {
  return kCmPerMetre * metrics::foot_slide(metrics::body_track(motion, motion.frame_rate()), plants).speed;
}

/// The blend with its planted feet held, where it has feet and they are to be held; tells what that did.
Motion with_feet_held(const EffortBlendArguments& arguments, const effort::Blend& made,
                      const std::optional<motion::Legs>& legs, const BvhLayout& layout, Diagnostics& diagnostics) {
  if (!arguments.clean_feet || made.plants.empty()) return made.motion;
  postprocess::FootskateOptions options;
  if (!holds_stretch(layout, *legs)) options.max_stretch = 0.0;
  return postprocess::clean_footskate(made.motion, *legs, made.plants, options, &diagnostics);
}

std::string clip_in_words(const std::string& path, const Motion& motion) {
  return fmt::format("{} ({:.2f} s)", path, motion.duration());
}

void print_report(const EffortBlendArguments& arguments, const Motion& first, const Motion& second,
                  const effort::Blend& made, const Motion& written) {
  fmt::print("{}: {} frames, {:.2f} s\n", arguments.output, written.num_frames(), written.duration());
  fmt::print("alpha {:g} from {} to {}\n", arguments.alpha, clip_in_words(arguments.first, first),
             clip_in_words(arguments.second, second));
  if (made.plants.empty()) {
    fmt::print("no footplants in either\n");
  } else if (arguments.clean_feet) {
    fmt::print("{} footplants; feet slide in them by {:.2f} cm/s, before they were held {:.2f} cm/s\n",
               made.plants.size(), slide(written, made.plants), slide(made.motion, made.plants));
  } else {
    fmt::print("{} footplants; feet slide in them by {:.2f} cm/s\n", made.plants.size(), slide(written, made.plants));
  }
}

void run(const EffortBlendArguments& arguments) {
  check_output(arguments.output, {arguments.first, arguments.second}, overwrite_if(arguments.force));
  PrintedDiagnostics diagnostics;
  const BvhClip clip = read_bvh(arguments.first, arguments.read, &diagnostics);
  const Motion second = read_second(arguments, clip.motion, diagnostics);
  const effort::SpaceTimeBlend blend = blend_of(arguments, clip.motion, second);
  const effort::Blend made = blend.at(arguments.alpha);
  if (arguments.alpha < blend.least_linear_alpha() || arguments.alpha > blend.greatest_linear_alpha()) {
    diagnostics.note("blend", fmt::format("alpha {:g} is beyond {:.2f} to {:.2f}, where timing goes on in proportion; "
                                          "farther out its rates change by constant factors",
                                          arguments.alpha, blend.least_linear_alpha(), blend.greatest_linear_alpha()));
  }
  const BvhLayout layout = default_layout(clip.motion.skeleton(), clip.layout.unit, clip.layout.up);
  const Motion written = with_feet_held(arguments, made, blend.legs(), layout, diagnostics);
  write_bvh(arguments.output, written, layout, overwrite_if(arguments.force), &diagnostics);
  print_report(arguments, clip.motion, second, made, written);
}

}  // namespace

void add_effort_blend(CLI::App& effort) {
  auto arguments = std::make_shared<EffortBlendArguments>();
  CLI::App* command = effort.add_subcommand(
      "blend", "Make a movement between two of like content, or beyond one of them, in posture, timing and travel");
  command->add_option("first", arguments->first, "BVH clip of a movement")->required()->type_name("A.bvh");
  command->add_option("second", arguments->second, "BVH clip of the same movement, done otherwise")
      ->required()
      ->type_name("B.bvh");
  command
      ->add_option("--alpha", arguments->alpha,
                   "How much of the second: 0 the first, 1 the second, outside 0 to 1 beyond them")
      ->required()
      ->check(number_in(effort::kLeastAlpha, effort::kLargestAlpha));
  command->add_option("-o,--output", arguments->output, "BVH file to write")->required();
  command
      ->add_option("--slope-limit", arguments->blend.slope_limit,
                   "One may run at most this many times as fast as the other where they do the same")
      ->check(number_in(1.01, align::kLargestSlopeLimit))
      ->capture_default_str();
  command->add_flag_callback(
      "--no-clean-feet", [arguments = arguments.get()] { arguments->clean_feet = false; },
      "Leave feet as they are blended instead of holding planted ones");
  add_bvh_read_options(*command, "--", arguments->read);
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
