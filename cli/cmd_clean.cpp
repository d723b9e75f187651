// SPDX-License-Identifier: MIT
// strut clean: holds the planted feet of a clip, and tells how far they slid and how far they were moved.
#include "commands.h"
#include "csv_table.h"
#include "feet_options.h"
#include "footplant_table.h"
#include "input_files.h"
#include "terminal.h"

#include <cmath>
#include <filesystem>
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
  FeetOptions feet;
  bool keep_layout = false, force = false;
};

/// A number of a row as a frame of the clip.
int frame_of(const std::string& path, const CsvRow& row, std::size_t number, int least, int greatest) {
  const double value = row.numbers[number];
  if (value == std::floor(value) && value >= least && value <= greatest) return static_cast<int>(value);
  throw ParseError(path, row.line, row.number_columns[number], fmt::format("a frame from {} to {}", least, greatest),
                   fmt::format("{:g}", value));
}

int foot_of(const std::string& path, const CsvRow& row) {
  for (const int foot : {0, 1}) {
    if (row.texts[1] == foot_name(foot)) return foot;
  }
  throw ParseError(path, row.line, row.text_columns[1], "left or right", "'" + row.texts[1] + "'");
}

/// The rows of a table that name the clip, by path, file name, or file name without its ending.
std::vector<motion::Footplant> footplants_of(const std::string& path, const std::string& clip, int num_frames) {
  const std::filesystem::path file(clip);
  std::vector<motion::Footplant> plants;
  for (const CsvRow& row : read_csv_rows(path, {"clip", "foot"}, {"begin", "end"})) {
    const std::filesystem::path name(row.texts[0]);
    if (name != file && name.filename() != file.filename() && name != file.stem()) continue;
    const int begin = frame_of(path, row, 0, 0, num_frames - 1);
    plants.push_back({foot_of(path, row), begin, frame_of(path, row, 1, begin + 1, num_frames)});
  }
  if (plants.empty()) {
    throw BadInput(path, "no footplants of " + clip, "the column 'clip' holds the clip's file name");
  }
  return plants;
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
               foot_name(moved.foot), moved.frame, moved.frame * before.frame_time());
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
  const motion::Legs legs = legs_of(arguments.clip, motion, arguments.feet);
  const auto plants = arguments.footplants.empty()
                          ? postprocess::detect_footplants(motion, legs)
                          : footplants_of(arguments.footplants, arguments.clip, motion.num_frames());
  const BvhLayout layout =
      arguments.keep_layout ? clip.layout : default_layout(motion.skeleton(), clip.layout.unit, clip.layout.up);
  postprocess::FootskateOptions options;
  if (!holds_stretch(layout, legs)) options.max_stretch = 0.0;
  const Motion cleaned = naming_the_file(
      arguments.clip, [&] { return postprocess::clean_footskate(motion, legs, plants, options, &diagnostics); });
  write_bvh(arguments.output, cleaned, layout, overwrite_if(arguments.force), &diagnostics);
  print_report(arguments, motion, cleaned, legs, plants);
}

}  // namespace

void add_clean(CLI::App& app) {
  auto arguments = std::make_shared<CleanArguments>();
  CLI::App* command = app.add_subcommand("clean", "Hold the planted feet of a clip");
  command->add_option("clip", arguments->clip, "BVH clip whose feet slide")->required();
  command->add_option("-o,--output", arguments->output, "BVH file to write")->required();
  command->add_option("--footplants", arguments->footplants,
                      "When feet are planted: a table with the columns clip, foot, begin and end (default: detected)");
  add_feet_option(*command, arguments->feet);
  command->add_flag("--keep-layout", arguments->keep_layout,
                    "Write the input file's channels instead of six on the root, three elsewhere");
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
