// SPDX-License-Identifier: MIT
// strut pair: clips in two styles in, a pair list out, and a summary from which a person sees what was paired and why.
#include "commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/io/pair_list.h>
#include <strut/learn/clip_pair.h>

namespace strut::cli {
namespace {

using learn::Pairing;
using learn::PairKind;
using learn::Stretch;

struct PairArguments {
  std::vector<std::string> inputs, outputs;
  std::string list;
  bool force = false;
  learn::PairingOptions options;
};

constexpr double kDegrees = 57.29577951308232;

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::vector<Motion> read_clips(const std::vector<std::string>& paths, Diagnostics& diagnostics) {
  std::vector<Motion> clips;
  for (const std::string& path : paths) {
    clips.push_back(read_bvh(path, {}, &diagnostics).motion);
    check_same_skeleton(path, clips.back().skeleton(), paths.front(), clips.front().skeleton());
  }
  return clips;
}

/// Files instead of clip numbers, where a person reads them.
void name_files(Diagnostics& found, const PairArguments& arguments, Diagnostics& named) {
  for (const Diagnostic& entry : found.entries()) {
    Diagnostic copy = entry;
    for (const auto& [style, files] :
         {std::pair{"input clip ", &arguments.inputs}, {"output clip ", &arguments.outputs}}) {
      for (std::size_t i = 0; i < files->size(); ++i) {
        if (entry.where == style + std::to_string(i)) copy.where = (*files)[i];
      }
    }
    if (copy.severity == Severity::kWarning) {
      named.warn(copy.where, copy.message, copy.hint);
    } else {
      named.note(copy.where, copy.message, copy.hint);
    }
  }
}

std::string range_of(const std::vector<Stretch>& stretches, double learn::PairFeatures::*feature, double scale,
                     int decimals) {
  double least = 1e300;
  double greatest = -1e300;
  for (const Stretch& stretch : stretches) {
    least = std::min(least, scale * stretch.features.*feature);
    greatest = std::max(greatest, scale * stretch.features.*feature);
  }
  return fmt::format("{:.{}f} to {:.{}f}", least, decimals, greatest, decimals);
}

std::vector<Stretch> of_kind(const std::vector<Stretch>& stretches, PairKind kind) {
  std::vector<Stretch> found;
  std::copy_if(stretches.begin(), stretches.end(), std::back_inserter(found),
               [&](const Stretch& stretch) { return stretch.kind == kind; });
  return found;
}

void print_style(const char* style, const std::vector<Stretch>& all, std::size_t num_clips) {
  fmt::print("{:<7} {} clips\n", style, num_clips);
  const auto cycles = of_kind(all, PairKind::kGaitCycle);
  if (!cycles.empty()) {
    const auto left = std::count_if(cycles.begin(), cycles.end(), [](const Stretch& s) { return s.foot == 0; });
    fmt::print("        {} gait cycles ({} left, {} right): {} s, {} m/s, turning {} degrees\n", cycles.size(), left,
               static_cast<std::ptrdiff_t>(cycles.size()) - left,
               range_of(cycles, &learn::PairFeatures::duration, 1.0, 2),
               range_of(cycles, &learn::PairFeatures::speed, 1.0, 2),
               range_of(cycles, &learn::PairFeatures::turning, kDegrees, 0));
  }
  const auto whole = of_kind(all, PairKind::kWhole);
  if (!whole.empty()) {
    fmt::print("        {} whole clips: {} s that move, joints by {} cm\n", whole.size(),
               range_of(whole, &learn::PairFeatures::duration, 1.0, 2),
               range_of(whole, &learn::PairFeatures::movement, 100.0, 0));
  }
}

/// Refusals and uncovered stretches, by reason and clip: a line each.
void print_left_over(const Pairing& pairing, const PairArguments& arguments) {
  std::map<std::string, int> reasons;
  for (const auto& refused : pairing.refused) {
    ++reasons[file_name(arguments.inputs[static_cast<std::size_t>(refused.input.clip)]) + " with " +
              file_name(arguments.outputs[static_cast<std::size_t>(refused.output.clip)]) + ": " + refused.reason];
  }
  for (const auto& [reason, count] : reasons) {
    fmt::print("        {}{}\n", reason, count > 1 ? fmt::format(" ({} times)", count) : "");
  }
  if (pairing.uncovered.empty()) return;
  fmt::print("not covered by the output style: {} of {} stretches of the input style\n", pairing.uncovered.size(),
             pairing.inputs.size());
  for (const Stretch& stretch : pairing.uncovered) {
    fmt::print("        {} frames {} to {}: {:.2f} s, {:.2f} m/s, turning {:.0f} degrees\n",
               file_name(arguments.inputs[static_cast<std::size_t>(stretch.clip)]), stretch.frames.begin,
               stretch.frames.end, stretch.features.duration, stretch.features.speed,
               kDegrees * stretch.features.turning);
  }
}

void print_summary(const Pairing& pairing, const PairArguments& arguments) {
  print_style("input", pairing.inputs, arguments.inputs.size());
  print_style("output", pairing.outputs, arguments.outputs.size());
  const auto wide = std::count_if(pairing.pairs.begin(), pairing.pairs.end(),
                                  [](const learn::ClipPair& pair) { return pair.slope_limit > 2; });
  fmt::print("pairs   {} made", pairing.pairs.size());
  if (wide > 0) fmt::print(" ({} of durations that differ by more than 1.8)", wide);
  fmt::print(", {} refused\n", pairing.refused.size());
  print_left_over(pairing, arguments);
}

std::string comment_of(const learn::ClipPair& pair) {
  if (pair.kind == PairKind::kGaitCycle) {
    return fmt::format(
        "{} cycle: {:.2f} -> {:.2f} m/s, turning {:+.0f} -> {:+.0f} degrees, {:.2f} -> {:.2f} s; distance {:.2f}",
        pair.foot == 0 ? "left" : "right", pair.input.speed, pair.output.speed, kDegrees * pair.input.turning,
        kDegrees * pair.output.turning, pair.input.duration, pair.output.duration, pair.distance);
  }
  return fmt::format("whole: {:.2f} -> {:.2f} s, joints move by {:.0f} -> {:.0f} cm; distance {:.2f}",
                     pair.input.duration, pair.output.duration, 100.0 * pair.input.movement,
                     100.0 * pair.output.movement, pair.distance);
}

std::vector<PairListEntry> entries_of(const Pairing& pairing, const PairArguments& arguments) {
  std::vector<PairListEntry> entries;
  for (const learn::ClipPair& pair : pairing.pairs) {
    PairListEntry entry;
    entry.input.path = arguments.inputs[static_cast<std::size_t>(pair.input_clip)];
    entry.input.frames = pair.input_frames;
    entry.output.path = arguments.outputs[static_cast<std::size_t>(pair.output_clip)];
    entry.output.frames = pair.output_frames;
    entry.comment = comment_of(pair);
    entries.push_back(std::move(entry));
  }
  return entries;
}

constexpr const char* kHeading =
    "Pairs made by `strut pair`. Take out what does not belong together, or add pairs of your own.\n"
    "Files are relative to this list; frames count from 0, the end is not included; without frames: the whole clip.";

void run_pair(const PairArguments& arguments) {
  const Overwrite overwrite = overwrite_if(arguments.force);
  check_output(arguments.list, arguments.inputs, overwrite);
  check_output(arguments.list, arguments.outputs, overwrite);
  PrintedDiagnostics diagnostics;
  const std::vector<Motion> inputs = read_clips(arguments.inputs, diagnostics);
  const std::vector<Motion> outputs = read_clips(arguments.outputs, diagnostics);
  check_same_skeleton(arguments.outputs.front(), outputs.front().skeleton(), arguments.inputs.front(),
                      inputs.front().skeleton());
  Diagnostics found;
  const Pairing pairing = learn::find_pairs(inputs, outputs, arguments.options, &found);
  name_files(found, arguments, diagnostics);
  print_summary(pairing, arguments);
  if (pairing.pairs.empty()) {
    throw BadInput(arguments.inputs.front(), "no pair could be made of these clips, nothing was written",
                   "give clips of the same action in both styles");
  }
  write_pair_list(arguments.list, entries_of(pairing, arguments), kHeading, overwrite);
  fmt::print("written {}\n", arguments.list);
}

}  // namespace

void add_pair(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "pair", "Pair clips of two styles for learning: gait cycles by speed and turning, other clips whole.");
  const auto arguments = std::make_shared<PairArguments>();
  command->add_option("--input", arguments->inputs, "Clips in the input style (BVH)")->required();
  command->add_option("--output", arguments->outputs, "Clips in the output style (BVH)")->required();
  command->add_option("-o,--out", arguments->list, "Pair list to write (TOML)")->required();
  command
      ->add_option("--neighbours", arguments->options.neighbours,
                   "Output stretches that every input stretch is paired with")
      ->capture_default_str()
      ->check(number_in(1, 100));
  command->add_flag("--whole", arguments->options.whole, "Pair whole clips even where they walk");
  command->add_flag("--force", arguments->force, "Overwrite the pair list if it is there");
  command->callback([arguments] { run_pair(*arguments); });
}

}  // namespace strut::cli
