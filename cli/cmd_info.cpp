// SPDX-License-Identifier: MIT
// strut info: what a file holds and what was assumed about it. One file in full, many as a line each; --json for
// programs.
#include "blend_report.h"
#include "bvh_options.h"
#include "commands.h"
#include "effort_model_info.h"
#include "input_files.h"
#include "model_info.h"
#include "terminal.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <strut/blend/gait_model_io.h>
#include <strut/core/error.h>
#include <strut/effort/effort_model_io.h>
#include <strut/effort/fragment_database.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model_io.h>
#include <strut/motion/kinematics.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::vector<std::string> files;
  BvhReadOptions read;
  bool json = false;
};

/// What is told about a clip.
struct ClipFacts {
  std::string path;
  BvhClip clip;
  double height = 0.0;    ///< vertical extent of the body in the first frame [m]
  double travel = 0.0;    ///< length of the pelvis' path over the ground [m]
  double distance = 0.0;  ///< from the pelvis' first to its last place on the ground [m]
};

Eigen::Vector3d on_ground(const Eigen::Vector3d& position) {
  return {position.x(), 0.0, position.z()};
}

double body_height(const Skeleton& skeleton, const Pose& pose) {
  const auto world = motion::forward_kinematics(skeleton, pose);
  const auto pelvis = static_cast<std::size_t>(skeleton.pelvis());
  double low = world.positions[pelvis].y(), high = low;
  for (std::size_t j = skeleton.children(skeleton.pelvis()).empty() ? 0 : pelvis; j < world.positions.size(); ++j) {
    const Eigen::Vector3d tip = world.positions[j] + world.rotations[j] * skeleton.joints()[j].end_site;
    low = std::min({low, world.positions[j].y(), tip.y()});
    high = std::max({high, world.positions[j].y(), tip.y()});
  }
  return high - low;
}

ClipFacts facts_of(const std::string& path, BvhClip clip) {
  ClipFacts facts{path, std::move(clip)};
  const Skeleton& skeleton = facts.clip.motion.skeleton();
  const auto& frames = facts.clip.motion.frames();
  facts.height = body_height(skeleton, frames.empty() ? rest_pose(skeleton) : frames.front());
  const auto pelvis = static_cast<std::size_t>(skeleton.pelvis());
  motion::WorldPose world;
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), last = first;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    motion::forward_kinematics(skeleton, frames[i], world);
    const Eigen::Vector3d place = on_ground(world.positions[pelvis]);
    if (i == 0) first = place;
    if (i > 0) facts.travel += (place - last).norm();
    last = place;
  }
  facts.distance = (last - first).norm();
  return facts;
}

const char* guessed(bool is_given) {
  return is_given ? "" : " (guessed)";
}

/// E.g. "position XYZ, rotation ZXY"; empty without channels.
std::string channels_in_words(const std::vector<BvhChannel>& channels) {
  std::string positions, rotations;
  for (const BvhChannel channel : channels) {
    const auto index = static_cast<int>(channel);
    (index < 3 ? positions : rotations) += "XYZ"[index % 3];
  }
  std::string text = positions.empty() ? "" : "position " + positions;
  if (!rotations.empty()) text += (text.empty() ? "rotation " : ", rotation ") + rotations;
  return text;
}

/// Joints above each one, at most as many as can be shown.
std::vector<std::size_t> depths_of(const Skeleton& skeleton) {
  constexpr std::size_t kDeepestShown = 30;
  std::vector<std::size_t> depths;
  for (const Joint& joint : skeleton.joints()) {
    depths.push_back(joint.parent < 0 ? 0
                                      : std::min(depths[static_cast<std::size_t>(joint.parent)] + 1, kDeepestShown));
  }
  return depths;
}

void print_hierarchy(const Skeleton& skeleton, const BvhLayout& layout) {
  std::vector<std::string> lines;
  std::size_t width = 0;
  const std::vector<std::size_t> depths = depths_of(skeleton);
  for (std::size_t j = 0; j < depths.size(); ++j) {
    const std::string& name = skeleton.joints()[j].name;
    const std::size_t indent = 4 + 2 * depths[j];
    lines.push_back(std::string(indent, ' ') + (name.empty() ? "(no name)" : name));
    width = std::max(width, lines.back().size());
  }
  fmt::print("  hierarchy\n");
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const std::string channels = channels_in_words(layout.channels[j]);
    fmt::print("{}\n", channels.empty() ? lines[j] : fmt::format("{:<{}}  {}", lines[j], width, channels));
  }
}

void print_clip(const ClipFacts& facts, const BvhReadOptions& given) {
  const auto& [motion, layout] = facts.clip;
  const Skeleton& skeleton = motion.skeleton();
  fmt::print("{}\n", facts.path);
  fmt::print("  frames     {} at {:g} frames/s: {:.2f} s\n", motion.num_frames(), motion.frame_rate(),
             motion.duration());
  fmt::print("  joints     {}, pelvis '{}', {} channels\n", skeleton.num_joints(),
             skeleton.joint(skeleton.pelvis()).name, layout.num_channels());
  fmt::print("  unit       {}{}\n", plural_name(layout.unit), guessed(given.unit.has_value()));
  fmt::print("  up axis    {}{}\n", axis_name(layout.up), guessed(given.up.has_value()));
  fmt::print("  height     {:.2f} m\n", facts.height);
  fmt::print("  travel     {:.2f} m, {:.2f} m from start to end\n", facts.travel, facts.distance);
  print_hierarchy(skeleton, layout);
}

void print_table(const std::vector<ClipFacts>& all) {
  fmt::print("{:>7} {:>8} {:>8} {:>6}  {:<11} {:<2} {:>8} {:>8}  {}\n", "frames", "frames/s", "seconds", "joints",
             "unit", "up", "height m", "travel m", "file");
  for (const ClipFacts& facts : all) {
    const auto& [motion, layout] = facts.clip;
    fmt::print("{:>7} {:>8.6g} {:>8.2f} {:>6}  {:<11} {:<2} {:>8.2f} {:>8.2f}  {}\n", motion.num_frames(),
               motion.frame_rate(), motion.duration(), motion.skeleton().num_joints(), plural_name(layout.unit),
               axis_name(layout.up), facts.height, facts.travel, facts.path);
  }
}

Json hierarchy_as_json(const Skeleton& skeleton, const BvhLayout& layout) {
  Json joints = Json::array();
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    const Joint& joint = skeleton.joint(j);
    const Eigen::Vector3d& offset = joint.offset;
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent},
                      {"offset_m", {offset.x(), offset.y(), offset.z()}},
                      {"channels", channels_in_words(layout.channels[static_cast<std::size_t>(j)])}});
  }
  return joints;
}

Json clip_as_json(const ClipFacts& facts, const BvhReadOptions& given) {
  const auto& [motion, layout] = facts.clip;
  return {{"file", facts.path},
          {"kind", "clip"},
          {"num_frames", motion.num_frames()},
          {"frame_rate", motion.frame_rate()},
          {"duration_s", motion.duration()},
          {"num_joints", motion.skeleton().num_joints()},
          {"num_channels", layout.num_channels()},
          {"unit", plural_name(layout.unit)},
          {"unit_guessed", !given.unit.has_value()},
          {"up", axis_name(layout.up)},
          {"up_guessed", !given.up.has_value()},
          {"height_m", facts.height},
          {"travel_m", facts.travel},
          {"distance_m", facts.distance},
          {"pelvis", motion.skeleton().pelvis()},
          {"joints", hierarchy_as_json(motion.skeleton(), layout)}};
}

/// The facts about many files, those that can be read; the first that cannot is thrown after all are told.
class InfoReport {
 public:
  explicit InfoReport(const InfoOptions& options) : options_(options) {}

  void add(const std::string& path) {
    try {
      if (effort::is_fragment_database(first_bytes(path))) return add_database(path);
      const std::string bytes = read_file(path);
      if (is_style_model(bytes)) return add_model(path, bytes);
      if (blend::is_gait_model(bytes)) return add_gait_model(path, bytes);
      if (effort::is_effort_model(bytes)) return add_effort_model(path, bytes);
      clips_.push_back(facts_of(path, parse_bvh(bytes, path, options_.read, &diagnostics_)));
    } catch (const Error& error) {
      if (failure_) say(fmt::format("{}\n", error.what()));
      if (!failure_) failure_ = std::current_exception();
    }
  }

  void print() const {
    if (options_.json) {
      Json list = models_;
      for (const ClipFacts& facts : clips_) list.push_back(clip_as_json(facts, options_.read));
      fmt::print("{}\n", list.dump(2, ' ', false, Json::error_handler_t::replace));
    } else if (options_.files.size() == 1 && clips_.size() == 1) {
      print_clip(clips_.front(), options_.read);
    } else if (!clips_.empty()) {
      print_table(clips_);
    }
    print_diagnostics(warnings());
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void add_model(const std::string& path, const std::string& bytes) {
    const auto model = parse_style_model(bytes, path);
    if (!options_.json) print_model(path, *model);
    models_.push_back(model_as_json(path, *model));
  }

  void add_gait_model(const std::string& path, const std::string& bytes) {
    const auto model = blend::parse_gait_model(bytes, path);
    if (!options_.json) print_gait_model(path, *model);
    models_.push_back(gait_model_as_json(path, *model));
  }

  void add_effort_model(const std::string& path, const std::string& bytes) {
    const auto model = effort::parse_effort_model(bytes, path);
    if (!options_.json) print_effort_model(path, *model);
    models_.push_back(effort_model_as_json(path, *model));
  }

  void add_database(const std::string& path) {
    const auto database = effort::FragmentDatabase::open(path);
    const effort::DatabaseCounts counts = database.counts();
    const Json facts = {{"file", path},
                        {"kind", "fragment database"},
                        {"frame_rate", database.frame_rate()},
                        {"num_joints", database.skeleton()->num_joints()},
                        {"clips", counts.clips},
                        {"frames", counts.frames},
                        {"fragments", counts.fragments},
                        {"groups", counts.groups},
                        {"pairs", counts.pairs},
                        {"accepted_pairs", counts.accepted_pairs},
                        {"blends", counts.blends},
                        {"labels", counts.labels},
                        {"raters", counts.raters},
                        {"estimates", counts.estimates}};
    if (!options_.json) {
      fmt::print("{}: fragment database\n", path);
      for (const auto& [name, value] : facts.items()) {
        if (value.is_number()) fmt::print("  {:<15} {}\n", name, value.dump());
      }
    }
    models_.push_back(facts);
  }

  /// What was assumed stands in the report itself.
  [[nodiscard]] Diagnostics warnings() const {
    Diagnostics warnings;
    for (const Diagnostic& entry : diagnostics_.entries()) {
      if (entry.severity == Severity::kWarning) warnings.warn(entry.where, entry.message, entry.hint);
    }
    return warnings;
  }

  const InfoOptions& options_;
  std::vector<ClipFacts> clips_;
  Json models_ = Json::array();
  Diagnostics diagnostics_;
  std::exception_ptr failure_;
};

}  // namespace

void add_info(CLI::App& app) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command = app.add_subcommand("info", "Show what a BVH clip or a model holds");
  command->add_option("FILE", options->files, "BVH clips (or models); many are shown as a line each")->required();
  command->add_flag("--json", options->json, "Print a JSON list instead of text: metres, seconds, frames per second");
  add_bvh_read_options(*command, "--", options->read);
  command->callback([options] {
    InfoReport report(*options);
    for (const std::string& path : options->files) report.add(path);
    report.print();
  });
}

}  // namespace strut::cli
