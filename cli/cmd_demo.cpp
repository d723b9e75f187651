// SPDX-License-Identifier: MIT
// strut demo: the whole job on clips of its own. A generated walker walks normally and with a limp; the limp is learnt
// from those clips as anybody would learn it, put on a walk that was not among them, and compared with how the walker
// itself limps that walk.
#include "clip_figures.h"
#include "commands.h"
#include "demo_picture.h"
#include "terminal.h"
#include "view/report.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>
#include <strut/io/pair_list.h>
#include <strut/learn/clip_pair.h>
#include <strut/learn/learn_style.h>
#include <strut/metrics/clip_distance.h>
#include <strut/metrics/gait.h>
#include <strut/model/style_model_io.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/translate/translate_motion.h>

namespace strut::cli {
namespace {

using generate::Schedule;
using generate::Walk;
using generate::WalkContent;
using generate::WalkStyle;

constexpr double kFrameRate = 30.0;   // of all clips, as most public motion has it
constexpr double kLongestStep = 1.2;  // [s]; what takes longer is a pause, not a step
constexpr double kPictureAt = 0.18;   // where in a clip the picture begins, of its duration

constexpr const char* kLead =
    "First a normal walk, then what strut made of it, then the true answer: the same steps as the walker really limps "
    "them.";

struct DemoOptions {
  std::string folder = "demo";
  bool force = false;
  std::uint64_t seed = 1;
};

WalkStyle normal_style(std::uint64_t seed) {
  return {.seed = seed};
}

WalkStyle limping_style(std::uint64_t seed) {
  return {.cadence_scale = 0.9,
          .step_length_scale = 0.85,
          .arm_swing = 0.28,
          .torso_lean = 0.10,
          .head_tilt = 0.08,
          .limp = 0.8,
          .seed = seed};
}

/// What the examples show: several speeds, turns to both sides, a change of speed, a stop.
std::vector<WalkContent> example_contents() {
  const double duration = 8.0;
  return {{.duration = duration, .speed = 1.3},
          {.duration = duration, .speed = 0.9},
          {.duration = duration, .speed = 1.6},
          {.duration = duration, .speed = 1.2, .turn_rate = 0.5},
          {.duration = duration, .speed = 1.2, .turn_rate = -0.5},
          {.duration = duration, .speed = 1.0, .turn_rate = 0.9},
          {.duration = duration, .speed = 1.0, .turn_rate = -0.9},
          {.duration = duration, .speed = Schedule({{0.0, 0.8}, {8.0, 1.5}})},
          {.duration = duration, .speed = Schedule({{2.0, 1.2}, {3.0, 0.0}, {5.0, 0.0}, {6.0, 1.2}})}};
}

/// What is translated: none of the examples. Straight on, to the left, a pause, to the right and off again.
WalkContent new_content() {
  return {.duration = 15.0,
          .speed = Schedule({{0.0, 1.15}, {5.5, 1.15}, {6.3, 0.0}, {8.0, 0.0}, {8.8, 1.1}, {12.0, 1.4}}),
          .turn_rate = Schedule(
              {{2.2, 0.0}, {2.8, 0.7}, {4.4, 0.7}, {5.0, 0.0}, {9.5, 0.0}, {10.1, -0.7}, {12.0, -0.7}, {12.6, 0.0}})};
}

/// The demo's files, by name.
class Folder {
 public:
  Folder(std::string path, bool force) : path_(std::move(path)), overwrite_(overwrite_if(force)) {
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error) throw FileError(FileAction::kWrite, path_, error.message());
  }
  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] Overwrite overwrite() const { return overwrite_; }

  /// Through a file and back, so that what is learnt from is what anybody can read.
  [[nodiscard]] Motion save_clip(const std::string& name, const Motion& motion) const {
    write_bvh(file(name), motion, default_layout(motion.skeleton()), overwrite_);
    return read_bvh(file(name), {.unit = LengthUnit::kCentimetre, .up = UpAxis::kY}).motion;
  }

 private:
  std::string path_;
  Overwrite overwrite_;
};

std::string clip_name(const std::string& style, std::size_t index) {
  return fmt::format("{}_{}.bvh", style, index + 1);
}

/// The example clips of one style with their files' names.
struct Examples {
  std::vector<std::string> names;
  std::vector<Motion> motions;
};

Examples make_examples(const Folder& folder, const std::string& style, WalkStyle (*make_style)(std::uint64_t),
                       std::uint64_t seed) {
  Examples examples;
  for (const WalkContent& content : example_contents()) {
    const Walk walk = generate::generate_walk(content, make_style(seed++), kFrameRate);
    examples.names.push_back(clip_name(style, examples.names.size()));
    examples.motions.push_back(folder.save_clip(examples.names.back(), walk.motion));
  }
  return examples;
}

/// Refuses before anything is computed or written.
void check_nothing_is_there(const Folder& folder) {
  std::vector<std::string> names = {"pairs.toml", "limp.strut", "input.bvh", "output.bvh",
                                    "truth.bvh",  "demo.html",  "demo.svg"};
  for (std::size_t i = 0; i < example_contents().size(); ++i) {
    for (const char* style : {"normal", "limp"}) names.push_back(clip_name(style, i));
  }
  for (const std::string& name : names) check_writable(folder.file(name), folder.overwrite());
}

/// What the walker's clips leave to be noted (a pause is no gait cycle) needs nobody's attention; warnings do.
void print_warnings(const Diagnostics& diagnostics) {
  Diagnostics warnings;
  for (const Diagnostic& entry : diagnostics.entries()) {
    if (entry.severity == Severity::kWarning) warnings.warn(entry.where, entry.message, entry.hint);
  }
  print_diagnostics(warnings);
}

std::vector<motion::Footplant> footplants_of(const Motion& motion) {
  return postprocess::detect_footplants(motion, motion::find_legs(motion).value());
}

/// Mean angle between the joints' rotations (the root's left out) at corresponding moments [rad].
double joint_angle_error(const Motion& motion, const Motion& truth, const std::vector<double>& truth_frames) {
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < motion.num_frames(); ++i) {
    const Pose other = motion::sample(truth, truth_frames[static_cast<std::size_t>(i)] * truth.frame_time());
    for (std::size_t j = 1; j < other.rotations.size(); ++j, ++count) {
      sum += motion.frame(i).rotations[j].angularDistance(other.rotations[j]);
    }
  }
  return sum / count;
}

/// How much longer the steps onto the bad (left) foot take than those onto the other.
double step_time_ratio(const Motion& motion) {
  std::vector<motion::Footplant> plants = footplants_of(motion);
  std::sort(plants.begin(), plants.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  double seconds[2] = {0.0, 0.0};
  int count[2] = {0, 0};
  for (std::size_t k = 1; k < plants.size(); ++k) {
    const double step = (plants[k].begin - plants[k - 1].begin) * motion.frame_time();
    if (plants[k].foot == plants[k - 1].foot || step > kLongestStep || plants[k - 1].begin == 0) continue;
    seconds[plants[k].foot] += step;
    ++count[plants[k].foot];
  }
  return count[0] * count[1] == 0 ? 1.0 : (seconds[0] / count[0]) / (seconds[1] / count[1]);
}

/// Input, output and true answer, and the output with the input's timing.
struct Result {
  Walk input, truth;
  Motion output, output_in_step;
};

/// What only the demo can measure, as it knows the true answer; of input, output and true answer.
std::vector<std::vector<ClipFigure>> figures_of(const Result& result) {
  const std::array<const Motion*, 3> motions = {&result.input.motion, &result.output, &result.truth.motion};
  const std::array<const Motion*, 2> in_step = {&result.input.motion, &result.output_in_step};
  const auto truth_frames = generate::true_correspondence(result.input, result.truth);
  const metrics::BodyTrack truth = metrics::body_track(result.truth.motion, metrics::kComparisonRate);
  std::vector<std::vector<ClipFigure>> figures;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const metrics::BodyTrack track = metrics::body_track(*motions[i], metrics::kComparisonRate);
    ClipFigure distance{.name = "Distance to the true answer", .value = {}, .unit = "cm", .better = "less"};
    ClipFigure angles{.name = "Joint angles off the true answer", .value = {}, .unit = "deg", .better = "less"};
    if (i < in_step.size()) {
      distance.value = kCmPerMetre * metrics::clip_distance(track, truth).distance;
      angles.value = joint_angle_error(*in_step[i], result.truth.motion, truth_frames) * 180.0 / std::numbers::pi;
    }
    figures.push_back({distance,
                       angles,
                       {"Duration", motions[i]->duration(), "s"},
                       {"Speed along the path", metrics::gait(track).travel / motions[i]->duration(), "m/s"},
                       {"Time of a step, bad over good foot", step_time_ratio(*motions[i]), ""}});
  }
  return figures;
}

/// The first landing of the left foot after kPictureAt of the clip [s].
double picture_begin(const DemoClip& clip) {
  for (const motion::Footplant& plant : clip.plants) {
    if (plant.foot == 0 && plant.begin > kPictureAt * clip.motion.num_frames()) {
      return plant.begin * clip.motion.frame_time();
    }
  }
  return 0.0;
}

std::string in_words(const std::optional<double>& value) {
  if (!value) return "-";
  return fmt::format("{:.{}f}", *value, std::abs(*value) < 9.995 ? 2 : 1);
}

void print_figures(const std::vector<ReportClip>& clips) {
  std::vector<std::vector<ClipFigure>> columns;
  fmt::print("\n{:46}", "");
  for (const ReportClip& clip : clips) {
    fmt::print("{:>14}", clip.name);
    columns.push_back(clip.figures);
    const auto measured = clip_figures(clip.motion, footplants_of(clip.motion));
    columns.back().insert(columns.back().end(), measured.begin(), measured.end());
  }
  for (std::size_t row = 0; row < columns.front().size(); ++row) {
    const ClipFigure& figure = columns.front()[row];
    fmt::print("\n{:46}", figure.unit.empty() ? figure.name : fmt::format("{} [{}]", figure.name, figure.unit));
    for (const auto& column : columns) fmt::print("{:>14}", in_words(column[row].value));
  }
  fmt::print("\n");
}

/// Seconds since `begin`.
double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void write_pairs(const Folder& folder, const Examples& normal, const Examples& limping,
                 const std::vector<learn::ClipPair>& pairs) {
  std::vector<PairListEntry> entries;
  for (const learn::ClipPair& pair : pairs) {
    PairListEntry entry;
    entry.input = {folder.file(normal.names[static_cast<std::size_t>(pair.input_clip)]), pair.input_frames, 0, 0};
    entry.output = {folder.file(limping.names[static_cast<std::size_t>(pair.output_clip)]), pair.output_frames, 0, 0};
    entries.push_back(entry);
  }
  write_pair_list(folder.file("pairs.toml"), entries, "Gait cycles of normal and limping walks. Made by strut demo.",
                  folder.overwrite());
}

/// Pairs the examples and learns from them, and tells both in sentences.
LearntStyle learn_limp(const Folder& folder, const Examples& normal, const Examples& limping, std::uint64_t seed,
                       std::vector<std::string>& facts) {
  Diagnostics diagnostics;
  const learn::Pairing pairing = learn::find_pairs(normal.motions, limping.motions, {}, &diagnostics);
  write_pairs(folder, normal, limping, pairing.pairs);
  ProgressLine progress("learning");
  const auto begin = std::chrono::steady_clock::now();
  LearntStyle learnt = learn_style(
      normal.motions, limping.motions, pairing.pairs, {},
      [seed](const LearnReport&) { return fmt::format("{{\"made_by\":\"strut demo\",\"seed\":{}}}", seed); },
      &diagnostics, [&](const std::string& step, int done, int total) { progress.update(step, done, total); });
  const double seconds = seconds_since(begin);
  write_style_model(folder.file("limp.strut"), *learnt.model, folder.overwrite());
  print_warnings(diagnostics);
  facts.push_back(
      fmt::format("A generated walker walked {0} clips normally (normal_1.bvh to normal_{0}.bvh) and {1} with "
                  "a limp on the left leg (limp_1.bvh to limp_{1}.bvh): several speeds, turns to both sides, a "
                  "stop. No two clips share their small variations from step to step.",
                  normal.motions.size(), limping.motions.size()));
  facts.push_back(fmt::format("They were cut into gait cycles and matched by speed and turning: {} pairs (pairs.toml).",
                              pairing.pairs.size()));
  facts.push_back(fmt::format("The limp was learnt from {} pairs in {:.1f} s: a radial map of {} centres (limp.strut).",
                              learnt.report.num_pairs, seconds, learnt.report.num_centres));
  return learnt;
}

Result translate_new_walk(const Folder& folder, const std::shared_ptr<const StyleModel>& model, std::uint64_t seed,
                          std::vector<std::string>& facts) {
  // The input and the true answer vary alike from step to step: the same steps, in two styles.
  Walk input = generate::generate_walk(new_content(), normal_style(seed), kFrameRate);
  Walk truth = generate::generate_walk(new_content(), limping_style(seed), kFrameRate);
  input.motion = folder.save_clip("input.bvh", input.motion);
  truth.motion = folder.save_clip("truth.bvh", truth.motion);
  Diagnostics diagnostics;
  const auto begin = std::chrono::steady_clock::now();
  const Motion translated = translate_motion(model, input.motion, {}, &diagnostics);
  const double seconds = seconds_since(begin);
  const Motion output = folder.save_clip("output.bvh", translated);
  Motion in_step = translate_motion(model, input.motion, {.retime = false});
  print_warnings(diagnostics);
  facts.push_back(
      fmt::format("A new walk with turns, a pause and changes of speed (input.bvh, {:.1f} s) was translated "
                  "(output.bvh) in {:.0f} ms.",
                  input.motion.duration(), 1000.0 * seconds));
  facts.emplace_back(
      "The true answer (truth.bvh) is how the walker itself limps the very same steps. Learning never saw "
      "it, nor the new walk.");
  return {std::move(input), std::move(truth), output, std::move(in_step)};
}

/// Input, output and true answer side by side.
std::vector<ReportClip> write_report(const Folder& folder, const Result& result, std::vector<std::string> facts) {
  const auto figures = figures_of(result);
  std::vector<ReportClip> clips = {{"Input", result.input.motion, {}, figures[0]},
                                   {"Output", result.output, {}, figures[1]},
                                   {"True answer", result.truth.motion, {}, figures[2]}};
  facts.insert(facts.begin(), kLead);
  write_file(folder.file("demo.html"),
             report_page(clips, {.title = "A limp, learnt and put on a new walk", .notes = facts}), folder.overwrite());
  return clips;
}

void write_picture(const Folder& folder, const Result& result) {
  const std::vector<DemoClip> clips = {
      {"Input", "a normal walk, not among the examples", result.input.motion, result.input.footplants},
      {"Output", "translated, by what was learnt", result.output, footplants_of(result.output)},
      {"True answer", "the same walk, really limped", result.truth.motion, result.truth.footplants}};
  std::vector<double> begins;
  for (const DemoClip& clip : clips) begins.push_back(picture_begin(clip));
  write_file(folder.file("demo.svg"), demo_picture(kLead, clips, begins), folder.overwrite());
}

void run(const DemoOptions& options) {
  const Folder folder(options.folder, options.force);
  check_nothing_is_there(folder);
  const std::uint64_t seed = 1000 * options.seed;  // room for every clip's own
  const Examples normal = make_examples(folder, "normal", normal_style, seed);
  const Examples limping = make_examples(folder, "limp", limping_style, seed + 100);
  std::vector<std::string> facts;
  const LearntStyle learnt = learn_limp(folder, normal, limping, options.seed, facts);
  const Result result = translate_new_walk(folder, learnt.model, seed + 200, facts);
  write_picture(folder, result);
  const std::vector<ReportClip> clips = write_report(folder, result, facts);
  for (const std::string& fact : facts) fmt::print("{}\n", fact);
  print_figures(clips);
  fmt::print("\nOpen {} in a browser to see the three side by side; {} is a still picture.\n", folder.file("demo.html"),
             folder.file("demo.svg"));
}

}  // namespace

void add_demo(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "demo", "Make clips of a walker, learn a limp from them, put it on a new walk, and write a report of it");
  const auto options = std::make_shared<DemoOptions>();
  command
      ->add_option("-o,--output", options->folder,
                   "Folder for the clips, the pair list, the model, the report and the picture; made if missing")
      ->type_name("FOLDER")
      ->capture_default_str();
  command->add_flag("--force", options->force, "Overwrite what an earlier run left in the folder (default: refuse)");
  command
      ->add_option("--seed", options->seed, "Seed of the walker's small variation from step to step; any whole number")
      ->type_name("N")
      ->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace strut::cli
