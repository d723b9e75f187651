// SPDX-License-Identifier: MIT
// strut clean: holds the planted feet of a clip, and tells how far they slid and how far they were moved.
#include "commands.h"
#include "csv_table.h"
#include "input_files.h"
#include "terminal.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/metrics/foot_slide.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/postprocess/footskate.h>

namespace strut::cli {
namespace {

constexpr double kCmPerMetre = 100.0;

struct CleanArguments {
  std::string clip, output, footplants;
  bool keep_layout = false, force = false;
};

int parse_foot(const std::string& path, const std::string& word) {
  if (word == "0" || word == "left") return 0;
  if (word == "1" || word == "right") return 1;
  throw BadInput(path, "expected left or right (or 0 or 1) as a foot, found '" + word + "'");
}

int frame_number(const std::string& path, double number) {
  const bool is_one = number >= 0.0 && number <= std::numeric_limits<int>::max() && number == std::floor(number);
  if (!is_one) throw BadInput(path, fmt::format("expected a frame number, found {}", number));
  return static_cast<int>(number);
}

/// The rows of a table that name the clip, by path, file name, or file name without its ending.
std::vector<motion::Footplant> read_footplants(const std::string& path, const std::string& clip, int num_frames) {
  const CsvColumns frames = read_csv_columns(path, {"begin", "end"}, "clip");
  const CsvColumns feet = read_csv_columns(path, {}, "foot");
  const std::filesystem::path file(clip);
  std::vector<motion::Footplant> plants;
  for (std::size_t i = 0; i < frames.labels.size(); ++i) {
    const std::string& name = frames.labels[i];
    if (name != clip && name != file.filename() && name != file.stem()) continue;
    const auto row = static_cast<Eigen::Index>(i);
    plants.push_back({parse_foot(path, feet.labels[i]), frame_number(path, frames.values(row, 0)),
                      frame_number(path, frames.values(row, 1))});
    if (plants.back().end <= plants.back().begin || plants.back().end > num_frames) {
      throw BadInput(path, fmt::format("frames {} to {} are not inside {}, which has {}", plants.back().begin,
                                       plants.back().end, clip, num_frames));
    }
  }
  if (plants.empty()) {
    throw BadInput(path, "no footplants of " + clip, "the column 'clip' holds the clip's file name");
  }
  return plants;
}

/// Bones can stretch in a file only where their joints have position channels.
bool holds_stretch(const BvhLayout& layout, const motion::Legs& legs) {
  for (const int foot : {0, 1}) {
    for (const int joint : {legs.foot(foot).knee, legs.foot(foot).ankle}) {
      if (layout.channels[static_cast<std::size_t>(joint)].size() < 6) return false;
    }
  }
  return true;
}

/// Where something is greatest in a clip.
struct Greatest {
  double value = 0.0;
  int foot = 0, frame = 0;
};

/// How far toes were moved [m].
Greatest greatest_move(const Motion& before, const Motion& after, const motion::Legs& legs) {
  Greatest greatest;
  motion::WorldPose a, b;
  for (int f = 0; f < before.num_frames(); ++f) {
    motion::forward_kinematics(before.skeleton(), before.frame(f), a);
    motion::forward_kinematics(after.skeleton(), after.frame(f), b);
    for (const int foot : {0, 1}) {
      const motion::Leg& leg = legs.foot(foot);
      const double moved = (motion::toe_position(leg, b) - motion::toe_position(leg, a)).norm();
      if (moved > greatest.value) greatest = {moved, foot, f};
    }
  }
  return greatest;
}

double slide(const Motion& motion, const std::vector<motion::Footplant>& plants) {
  const auto track = metrics::body_track(motion, metrics::measuring_rate(motion.frame_rate()));
  return kCmPerMetre * metrics::foot_slide(track, plants).speed;
}

void print_report(const CleanArguments& arguments, const Motion& before, const Motion& after, const motion::Legs& legs,
                  const std::vector<motion::Footplant>& plants) {
  const Greatest moved = greatest_move(before, after, legs);
  fmt::print("{}: {} frames, {} footplants\n", arguments.output, after.num_frames(), plants.size());
  fmt::print("feet slide in footplants by {:.2f} cm/s, before {:.2f} cm/s\n", slide(after, plants),
             slide(before, plants));
  if (moved.value > 0.0) {
    fmt::print("feet moved by at most {:.1f} cm: the {} at frame {} ({:.2f} s)\n", kCmPerMetre * moved.value,
               moved.foot == 0 ? "left" : "right", moved.frame, moved.frame * before.frame_time());
  }
}

void run(const CleanArguments& arguments) {
  std::vector<std::string> inputs{arguments.clip};
  if (!arguments.footplants.empty()) inputs.push_back(arguments.footplants);
  check_output(arguments.output, inputs, overwrite_if(arguments.force));
  PrintedDiagnostics diagnostics;
  const BvhClip clip = read_bvh(arguments.clip, {}, &diagnostics);
  const Motion& motion = clip.motion;
  if (motion.num_frames() < 2) throw BadInput(arguments.clip, "at least two frames are needed");
  const auto legs = motion::find_legs(motion);
  if (!legs) throw BadInput(arguments.clip, "no legs are found in its skeleton");
  const auto plants = arguments.footplants.empty()
                          ? postprocess::detect_footplants(motion, *legs)
                          : read_footplants(arguments.footplants, arguments.clip, motion.num_frames());
  const BvhLayout layout =
      arguments.keep_layout ? clip.layout : default_layout(motion.skeleton(), clip.layout.unit, clip.layout.up);
  postprocess::FootskateOptions options;
  if (!holds_stretch(layout, *legs)) options.max_stretch = 0.0;
  const Motion cleaned = naming_the_file(
      arguments.clip, [&] { return postprocess::clean_footskate(motion, *legs, plants, options, &diagnostics); });
  write_bvh(arguments.output, cleaned, layout, overwrite_if(arguments.force), &diagnostics);
  print_report(arguments, motion, cleaned, *legs, plants);
}

}  // namespace

void add_clean(CLI::App& app) {
  auto arguments = std::make_shared<CleanArguments>();
  CLI::App* command = app.add_subcommand("clean", "Hold the planted feet of a clip");
  command->add_option("clip", arguments->clip, "BVH clip whose feet slide")->required();
  command->add_option("-o,--output", arguments->output, "BVH file to write")->required();
  command->add_option("--footplants", arguments->footplants,
                      "When feet are planted: a table with the columns clip, foot, begin and end (default: detected)");
  command->add_flag("--keep-layout", arguments->keep_layout,
                    "Write the input file's channels instead of six on the root, three elsewhere");
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
