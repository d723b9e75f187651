// SPDX-License-Identifier: MIT
// strut measure: how much the feet of clips slide, how smooth they are, how they walk, and how far they are from other
// clips: each figure with its worst value, where and when. As text for a person or as JSON for a program.
#include "clip_figures.h"
#include "commands.h"
#include "input_files.h"
#include "terminal.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/metrics/clip_distance.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureOptions {
  std::vector<std::string> clips;
  std::vector<std::string> against;
  bool json = false;
};

/// A file, read and brought to the rate at which clips are compared.
struct Clip {
  std::string path;
  Motion motion;
  metrics::BodyTrack track;
};

/// What was measured of one clip.
struct Figures {
  ClipMeasures own;
  std::vector<metrics::ClipDistance> distances;  ///< to each of the other clips
};

std::vector<Clip> read_clips(const std::vector<std::string>& paths, Diagnostics& diagnostics) {
  std::vector<Clip> clips;
  for (const std::string& path : paths) {
    Motion motion = read_bvh(path, {}, &diagnostics).motion;
    auto track = naming_the_file(path, [&] { return metrics::body_track(motion, metrics::kComparisonRate); });
    clips.push_back({path, std::move(motion), std::move(track)});
  }
  return clips;
}

std::vector<metrics::ClipDistance> distances_to(const Clip& clip, const std::vector<Clip>& others) {
  std::vector<metrics::ClipDistance> distances;
  for (const Clip& other : others) {
    check_same_skeleton(other.path, other.motion.skeleton(), clip.path, clip.motion.skeleton());
    distances.push_back(metrics::clip_distance(clip.track, other.track));
  }
  return distances;
}

Figures measure(const Clip& clip, const std::vector<Clip>& others) {
  return naming_the_file(clip.path, [&] {
    const auto plants = postprocess::detect_footplants(clip.motion, motion::find_legs(clip.motion).value());
    return Figures{measure_clip(clip.motion, plants), distances_to(clip, others)};
  });
}

double mean_distance(const Figures& figures) {
  double sum = 0.0;
  for (const metrics::ClipDistance& distance : figures.distances) sum += distance.distance;
  return sum / static_cast<double>(figures.distances.size());
}

double mean_distance(const std::vector<Figures>& all) {
  double sum = 0.0;
  for (const Figures& figures : all) sum += mean_distance(figures);
  return sum / static_cast<double>(all.size());
}

std::string told(const Clip& clip, const metrics::Place& place) {
  const std::string joint = joint_name(clip.motion, place.joint);
  return fmt::format("{}{}frame {} ({:.2f} s)", joint, joint.empty() ? "" : " at ", place.frame, place.time);
}

// ---- for a person ---------------------------------------------------------------------------------------------------

void print_figures(const Clip& clip, const Figures& figures) {
  const auto& [slide, planted, num_footplants, smoothness, gait] = figures.own;
  fmt::print("{}: {} frames at {:g} frames/s\n", clip.path, clip.motion.num_frames(), clip.motion.frame_rate());
  fmt::print("  foot slide  {:8.2f} cm/s     worst {:.2f} cm/s: {}\n", kCmPerMetre * slide.speed,
             kCmPerMetre * slide.worst_speed, told(clip, slide.worst));
  if (planted.worst.joint >= 0) {
    fmt::print("  in plants   {:8.2f} cm/s     worst {:.2f} cm/s: {}; {} footplants\n", kCmPerMetre * planted.speed,
               kCmPerMetre * planted.worst_speed, told(clip, planted.worst), num_footplants);
  }
  fmt::print("  jerk        {:8.1f} m/s^3    worst {:.0f} m/s^3: {}\n", smoothness.jerk, smoothness.worst_jerk,
             told(clip, smoothness.worst));
  fmt::print("  largest pop {:8.2f} cm       {}\n", kCmPerMetre * smoothness.pop, told(clip, smoothness.worst_pop));
  fmt::print("  speed       {:8.2f} m/s      fastest {:.2f} m/s: {}\n", gait.speed, gait.top_speed,
             told(clip, gait.fastest));
  fmt::print("  cadence     {:8.2f} steps/s", gait.cadence);
  if (gait.longest_step > 0.0) {
    fmt::print("  longest step {:.2f} s: {}", gait.longest_step, told(clip, gait.longest_step_begin));
  }
  fmt::print("\n");
}

void print_distance(const Clip& clip, const Clip& other, const metrics::ClipDistance& found) {
  const metrics::WorstMatch& worst = found.worst;
  const Clip& source = worst.in_first ? clip : other;
  fmt::print("  distance    {:8.2f} cm       to {}\n", kCmPerMetre * found.distance, other.path);
  fmt::print("{:29}worst {:.2f} cm ({} {:.2f} cm): from frame {} ({:.2f} s) of {}\n", "", kCmPerMetre * worst.distance,
             joint_name(source.motion, worst.begin.joint), kCmPerMetre * worst.joint_distance, worst.begin.frame,
             worst.begin.time, source.path);
}

void print_report(const std::vector<Clip>& clips, const std::vector<Clip>& others, const std::vector<Figures>& all) {
  for (std::size_t i = 0; i < clips.size(); ++i) {
    print_figures(clips[i], all[i]);
    for (std::size_t k = 0; k < others.size(); ++k) print_distance(clips[i], others[k], all[i].distances[k]);
    if (others.size() > 1) fmt::print("  mean        {:8.2f} cm\n", kCmPerMetre * mean_distance(all[i]));
  }
  if (others.empty() || clips.size() < 2) return;
  fmt::print("mean distance of {} clips: {:.2f} cm\n", clips.size(), kCmPerMetre * mean_distance(all));
}

// ---- for a program --------------------------------------------------------------------------------------------------

Json json_place(const Clip& clip, const metrics::Place& place) {
  Json json{{"frame", place.frame}, {"time_s", place.time}};
  if (place.joint >= 0) json["joint"] = joint_name(clip.motion, place.joint);
  return json;
}

Json json_worst(const Clip& clip, const char* key, double value, const metrics::Place& place) {
  Json json = json_place(clip, place);
  json[key] = value;
  return json;
}

Json json_figures(const Clip& clip, const Figures& figures) {
  const auto& [slide, planted, num_footplants, smoothness, gait] = figures.own;
  Json json{{"path", clip.path}, {"frames", clip.motion.num_frames()}, {"frame_rate", clip.motion.frame_rate()}};
  json["foot_slide_cm_per_s"] = kCmPerMetre * slide.speed;
  json["worst_foot_slide"] = json_worst(clip, "cm_per_s", kCmPerMetre * slide.worst_speed, slide.worst);
  json["footplants"] = num_footplants;
  if (planted.worst.joint >= 0) {
    json["planted_slide_cm_per_s"] = kCmPerMetre * planted.speed;
    json["worst_planted_slide"] = json_worst(clip, "cm_per_s", kCmPerMetre * planted.worst_speed, planted.worst);
  }
  json["jerk_m_per_s3"] = smoothness.jerk;
  json["worst_jerk"] = json_worst(clip, "m_per_s3", smoothness.worst_jerk, smoothness.worst);
  json["largest_pop"] = json_worst(clip, "cm", kCmPerMetre * smoothness.pop, smoothness.worst_pop);
  json["travel_m"] = gait.travel;
  json["speed_m_per_s"] = gait.speed;
  json["fastest"] = json_worst(clip, "m_per_s", gait.top_speed, gait.fastest);
  json["cadence_per_s"] = gait.cadence;
  if (gait.longest_step > 0.0) {
    json["longest_step"] = json_worst(clip, "seconds", gait.longest_step, gait.longest_step_begin);
  }
  return json;
}

Json json_distance(const Clip& clip, const Clip& other, const metrics::ClipDistance& found) {
  const metrics::WorstMatch& worst = found.worst;
  const Clip& source = worst.in_first ? clip : other;
  const Clip& target = worst.in_first ? other : clip;
  Json json{{"path", other.path}, {"distance_cm", kCmPerMetre * found.distance}};
  json["worst"] = json_worst(source, "distance_cm", kCmPerMetre * worst.distance, worst.begin);
  json["worst"]["path"] = source.path;
  json["worst"]["joint_distance_cm"] = kCmPerMetre * worst.joint_distance;
  json["worst"]["match"] = {
      {"path", target.path}, {"frame", worst.match_begin.frame}, {"time_s", worst.match_begin.time}};
  return json;
}

Json json_report(const std::vector<Clip>& clips, const std::vector<Clip>& others, const std::vector<Figures>& all) {
  Json report{{"clips", Json::array()}};
  for (std::size_t i = 0; i < clips.size(); ++i) {
    Json& json = report["clips"].emplace_back(json_figures(clips[i], all[i]));
    for (std::size_t k = 0; k < others.size(); ++k) {
      json["against"].push_back(json_distance(clips[i], others[k], all[i].distances[k]));
    }
    if (!others.empty()) json["distance_cm"] = kCmPerMetre * mean_distance(all[i]);
  }
  if (!others.empty()) report["distance_cm"] = kCmPerMetre * mean_distance(all);
  return report;
}

void run(const MeasureOptions& options) {
  PrintedDiagnostics diagnostics;
  const auto clips = read_clips(options.clips, diagnostics);
  const auto others = read_clips(options.against, diagnostics);
  std::vector<Figures> all;
  all.reserve(clips.size());
  for (const Clip& clip : clips) all.push_back(measure(clip, others));
  if (options.json) {
    fmt::print("{}\n", json_report(clips, others, all).dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_report(clips, others, all);
  }
}

}  // namespace

void add_measure(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "measure", "Measure clips: foot slide, smoothness, speed, cadence, and the distance to other clips");
  const auto options = std::make_shared<MeasureOptions>();
  command->add_option("clips", options->clips, "BVH files to measure")->required()->type_name("CLIP");
  command
      ->add_option("--against", options->against,
                   "BVH files of the same skeleton; the distance [cm] of every clip to each of them is measured too "
                   "(default: none)")
      ->type_name("REAL");
  command->add_flag("--json", options->json,
                    "Print JSON, lengths and speeds in the units its keys name (default: text)");
  command->callback([options] { run(*options); });
}

}  // namespace strut::cli
