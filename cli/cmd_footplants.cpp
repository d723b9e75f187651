// SPDX-License-Identifier: MIT
// strut footplants: when the feet of clips are planted. As text for a person, as CSV that strut learn reads, or as JSON
// for a program.
#include "bvh_options.h"
#include "commands.h"
#include "feet_options.h"
#include "footplant_table.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

struct FootplantsArguments {
  std::vector<std::string> clips;
  std::string output;
  BvhReadOptions read;
  FeetOptions feet;
  postprocess::FootplantDetectorOptions detector;
  bool csv = false, json = false, force = false;
};

ClipFootplants find(const std::string& path, const FootplantsArguments& arguments, Diagnostics& diagnostics) {
  const Motion clip = read_bvh(path, arguments.read, &diagnostics).motion;
  const motion::Legs legs = legs_of(path, clip, arguments.feet);
  return {path, clip.num_frames(), clip.frame_rate(), postprocess::detect_footplants(clip, legs, arguments.detector)};
}

std::string as_text(const std::vector<ClipFootplants>& clips) {
  std::string text;
  for (const ClipFootplants& clip : clips) {
    text += fmt::format("{}: {} frames at {:g} frames/s, {} footplants\n", clip.path, clip.num_frames, clip.frame_rate,
                        clip.footplants.size());
    if (!clip.footplants.empty())
      text += fmt::format("  {:<6}{:>7}{:>7}{:>10}{:>9}\n", "foot", "begin", "end", "s", "s");
    for (const motion::Footplant& plant : clip.footplants) {
      text += fmt::format("  {:<6}{:>7}{:>7}{:>10.2f}{:>9.2f}\n", foot_name(plant.foot), plant.begin, plant.end,
                          plant.begin / clip.frame_rate, plant.end / clip.frame_rate);
    }
  }
  return text;
}

std::string as_json(const std::vector<ClipFootplants>& clips) {
  Json list = Json::array();
  for (const ClipFootplants& clip : clips) {
    Json plants = Json::array();
    for (const motion::Footplant& plant : clip.footplants) {
      plants.push_back({{"foot", foot_name(plant.foot)},
                        {"begin", plant.begin},
                        {"end", plant.end},
                        {"begin_s", plant.begin / clip.frame_rate},
                        {"end_s", plant.end / clip.frame_rate}});
    }
    list.push_back(
        {{"path", clip.path}, {"frames", clip.num_frames}, {"frame_rate", clip.frame_rate}, {"footplants", plants}});
  }
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void run(const FootplantsArguments& arguments) {
  const Overwrite overwrite = overwrite_if(arguments.force);
  if (!arguments.output.empty()) check_output(arguments.output, arguments.clips, overwrite);
  PrintedDiagnostics diagnostics;
  std::vector<ClipFootplants> clips;
  for (const std::string& path : arguments.clips) clips.push_back(find(path, arguments, diagnostics));
  const bool wants_csv = arguments.csv || !arguments.output.empty();
  const std::string text = arguments.json ? as_json(clips) : wants_csv ? format_footplants(clips) : as_text(clips);
  if (arguments.output.empty()) {
    fmt::print("{}", text);
  } else {
    write_file(arguments.output, text, overwrite);
  }
}

}  // namespace

void add_footplants(CLI::App& app) {
  CLI::App* command = app.add_subcommand("footplants", "List when the feet of clips are planted");
  const auto arguments = std::make_shared<FootplantsArguments>();
  command->add_option("clips", arguments->clips, "BVH files")->required()->type_name("CLIP");
  CLI::Option* csv =
      command->add_flag("--csv", arguments->csv, "Print comma-separated values, which strut learn --footplants reads");
  command->add_flag("--json", arguments->json, "Print JSON: frames and seconds")->excludes(csv);
  command->add_option("-o,--output", arguments->output, "File to write instead of printing: CSV, or JSON with --json");
  add_feet_option(*command, arguments->feet);
  command
      ->add_option("--height", arguments->detector.height,
                   "Higher than this above its lowest place, in leg lengths, a toe has not landed; raise it where the "
                   "ground is uneven")
      ->check(number_in(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--shortest", arguments->detector.shortest_plant, "Shorter footplants are passed over [s]")
      ->check(number_in(0.0, 10.0))
      ->capture_default_str();
  add_bvh_read_options(*command, "--", arguments->read);
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] {
    auto& detector = arguments->detector;
    // What has landed has not left.
    detector.leaving_height = std::max(detector.leaving_height, 2.0 * detector.height);
    run(*arguments);
  });
}

}  // namespace strut::cli
