// SPDX-License-Identifier: MIT
// strut convert: a BVH clip written in other units, with another axis up, at another frame rate, in part, or in the
// layout every program reads alike.
#include "bvh_options.h"
#include "commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/motion/resample.h>

namespace strut::cli {
namespace {

/// A range of frames, from 0, end not included; what is missing is the clip's own.
struct FrameRange {
  std::optional<int> begin, end;
};

struct ConvertOptions {
  std::string input, output;
  BvhReadOptions read;
  std::optional<LengthUnit> unit;
  std::optional<UpAxis> up;
  std::vector<BvhChannel> rotation_order;
  std::optional<double> frame_rate;
  FrameRange frames;
  double scale = 1.0;
  bool keep_layout = false;
  bool force = false;
};

std::optional<int> parse_frame(const std::string& word, const std::string& range) {
  if (word.empty()) return std::nullopt;
  int frame = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), frame);
  if (error != std::errc() || end != word.data() + word.size() || frame < 0) {
    throw CLI::ValidationError("--frames", "expected BEGIN:END with frames from 0, got '" + range + "'");
  }
  return frame;
}

FrameRange parse_range(const std::string& range) {
  const auto colon = range.find(':');
  if (colon == range.npos) {
    throw CLI::ValidationError("--frames", "expected BEGIN:END with frames from 0, got '" + range + "'");
  }
  FrameRange result = {parse_frame(range.substr(0, colon), range), parse_frame(range.substr(colon + 1), range)};
  if (result.begin && result.end && *result.begin >= *result.end) {
    throw CLI::ValidationError("--frames", "expected BEGIN before END, got '" + range + "'");
  }
  return result;
}

std::vector<BvhChannel> parse_rotation_order(const std::string& word) {
  std::vector<BvhChannel> order;
  for (const char c : word) {
    const auto axis = std::string("xyz").find(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
    if (axis == std::string::npos) break;
    order.push_back(static_cast<BvhChannel>(static_cast<std::size_t>(BvhChannel::kXRotation) + axis));
  }
  std::vector<BvhChannel> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  if (word.size() != 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end() || order.size() != 3) {
    throw CLI::ValidationError("--rotation-order", "expected x, y and z once each, e.g. zxy, got '" + word + "'");
  }
  return order;
}

Motion scaled(const Motion& motion, double scale) {
  std::vector<Joint> joints = motion.skeleton().joints();
  for (Joint& joint : joints) {
    joint.offset *= scale;
    joint.end_site *= scale;
  }
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    for (auto& translation : pose.translations) translation *= scale;
  }
  return {std::make_shared<const Skeleton>(std::move(joints)), motion.frame_rate(), std::move(frames)};
}

BvhLayout target_layout(const BvhClip& clip, const ConvertOptions& options) {
  const LengthUnit unit = options.unit.value_or(clip.layout.unit);
  const UpAxis up = options.up.value_or(clip.layout.up);
  if (!options.keep_layout) {
    return options.rotation_order.empty() ? default_layout(clip.motion.skeleton(), unit, up)
                                          : default_layout(clip.motion.skeleton(), unit, up, options.rotation_order);
  }
  BvhLayout layout = with_units(clip.layout, unit, up);
  layout.first_source_row = options.frames.begin.value_or(0);
  return layout;
}

Motion converted(const Motion& source, const ConvertOptions& options) {
  const int begin = options.frames.begin.value_or(0), end = options.frames.end.value_or(source.num_frames());
  if (end > source.num_frames() || (options.frames.begin && begin >= end)) {
    throw InvalidArgument("--frames", fmt::format("a range inside 0:{}", source.num_frames()),
                          fmt::format("{}:{}", begin, end));
  }
  Motion motion = source.slice(begin, end);
  if (options.frame_rate) motion = motion::resample(motion, *options.frame_rate);
  return options.scale == 1.0 ? motion : scaled(motion, options.scale);
}

void convert(const ConvertOptions& options) {
  check_writable(options.output, overwrite_if(options.force));
  PrintedDiagnostics diagnostics;
  const BvhClip clip = read_bvh(options.input, options.read, &diagnostics);
  BvhLayout layout = target_layout(clip, options);
  const Motion motion = converted(clip.motion, options);
  if (motion.frame_rate() != clip.motion.frame_rate()) layout.source_values.reset();
  write_bvh(options.output, motion, layout, overwrite_if(options.force), &diagnostics);
}

void add_target_options(CLI::App& command, ConvertOptions& options) {
  command
      .add_option_function<std::string>(
          "--unit", [&options](const std::string& word) { options.unit = parse_unit("--unit", word); },
          "Unit of the lengths in the output: m, cm, mm, in or ft (default: the input's)")
      ->type_name("UNIT");
  command
      .add_option_function<std::string>(
          "--up", [&options](const std::string& word) { options.up = parse_up("--up", word); },
          "Axis that points up in the output: y or z (default: the input's)")
      ->type_name("AXIS");
  command
      .add_option_function<double>(
          "--frame-rate", [&options](double rate) { options.frame_rate = rate; },
          "Frames per second of the output; poses between frames are interpolated (default: the input's)")
      ->check(number_in(1e-3, 1e5))
      ->type_name("RATE");
  command
      .add_option_function<std::string>(
          "--frames", [&options](const std::string& range) { options.frames = parse_range(range); },
          "Only the input's frames from BEGIN on and before END, counted from 0; either may be left out (default: all)")
      ->type_name("BEGIN:END");
  command.add_option("--scale", options.scale, "Factor for all lengths (default: 1)")
      ->check(number_in(1e-6, 1e6))
      ->type_name("FACTOR");
  CLI::Option* keep = command.add_flag(
      "--keep-layout", options.keep_layout,
      "Write the input's channels and header (default: root OFFSET 0 with six channels, three rotations elsewhere)");
  command
      .add_option_function<std::string>(
          "--rotation-order",
          [&options](const std::string& word) { options.rotation_order = parse_rotation_order(word); },
          "Order of the rotation channels (default: zxy)")
      ->type_name("ORDER")
      ->excludes(keep);
}

}  // namespace

void add_convert(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command =
      app.add_subcommand("convert", "Write a BVH clip in other units, axes, frame rate, range or layout");
  command->add_option("IN", options->input, "BVH clip")->required();
  command->add_option("-o,--output", options->output, "BVH file to write")->required()->type_name("OUT");
  add_target_options(*command, *options);
  add_bvh_read_options(*command, "--from-", options->read);
  command->add_flag("--force", options->force, "Overwrite the output if it exists (default: refuse)");
  command->callback([options] { convert(*options); });
}

}  // namespace strut::cli
