// SPDX-License-Identifier: MIT
// What footskate cleanup does to translated clips, and to generated walks that were made to slide; prints the tables of
// docs/footskate.md. Footplants are the detector's, on the clip as it comes.
//   footskate_study DATA [LEARNT_FIRST LEARNT_LAST JUDGED_FIRST JUDGED_LAST]   styles learnt, takes translated, cleaned
//   footskate_study --walks                                                    generated walks with slide added
//   footskate_study --clips CLIP.bvh...                                        any clips, a row each
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <strut/generate/walker.h>
#include <strut/io/bvh.h>
#include <strut/learn/clip_pair.h>
#include <strut/learn/learn_style.h>
#include <strut/math/rotation.h>
#include <strut/metrics/foot_slide.h>
#include <strut/motion/kinematics.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/postprocess/footskate.h>
#include <strut/translate/translate_motion.h>

namespace {

using namespace strut;
using Eigen::Vector3d;

constexpr double kQuantile = 0.99;      // of a joint's accelerations in the clip as it comes
constexpr double kLeastAngular = 10.0;  // smaller accelerations are no movement to compare with [rad/s^2]
constexpr double kLeastStraight = 0.5;  // the same of the pelvis [m/s^2]

// ---- what is measured of a clip -------------------------------------------------------------------------------------

struct Figures {
  double in_plants = 0.0, worst_plant = 0.0, anywhere = 0.0;  // slide [cm/s]
};

Figures slides(const Motion& clip, const std::vector<motion::Footplant>& plants) {
  const auto track = metrics::body_track(clip, metrics::measuring_rate(clip.frame_rate()));
  const auto planted = metrics::foot_slide(track, plants);
  return {100.0 * planted.speed, 100.0 * planted.worst_speed, 100.0 * metrics::foot_slide(track).speed};
}

/// Of every joint's rotation in its parent's frame [rad/s^2], and last of the pelvis in the world [m/s^2].
std::vector<std::vector<double>> accelerations(const Motion& clip) {
  const auto joints = static_cast<std::size_t>(clip.skeleton().num_joints());
  const double rate = clip.frame_rate();
  std::vector<std::vector<double>> found(joints + 1);
  const auto places = motion::joint_positions_world(clip);
  const auto pelvis = static_cast<std::size_t>(clip.skeleton().pelvis());
  for (int t = 1; t + 1 < clip.num_frames(); ++t) {
    const auto f = static_cast<std::size_t>(t);
    for (std::size_t j = 0; j < joints; ++j) {
      const auto &a = clip.frame(t - 1).rotations[j], &b = clip.frame(t).rotations[j],
                 &c = clip.frame(t + 1).rotations[j];
      const Vector3d before = math::log_map(b * a.conjugate()), after = math::log_map(c * b.conjugate());
      found[j].push_back((after - before).norm() * rate * rate);
    }
    found[joints].push_back((places[f + 1][pelvis] - 2.0 * places[f][pelvis] + places[f - 1][pelvis]).norm() * rate *
                            rate);
  }
  return found;
}

double quantile(std::vector<double> values, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

/// The greatest acceleration of any joint that cleanup moves, against the 99th percentile of the same joint in the clip
/// as it comes.
struct Sharpest {
  double ratio = 0.0;
  std::string joint;
  int frame = 0;
};

Sharpest sharpest(const Motion& clip, const std::vector<std::vector<double>>& reference, const motion::Legs& legs) {
  Sharpest worst;
  const auto found = accelerations(clip);
  for (std::size_t j = 0; j < found.size(); ++j) {
    const bool is_pelvis = j + 1 == found.size();
    const auto is_of = [j = static_cast<int>(j)](const motion::Leg& leg) {
      return j == leg.hip || j == leg.knee || j == leg.ankle;
    };
    if (!is_pelvis && !is_of(legs.left) && !is_of(legs.right)) continue;  // cleanup does not touch it
    const double usual = std::max(quantile(reference[j], kQuantile), is_pelvis ? kLeastStraight : kLeastAngular);
    const auto greatest = std::max_element(found[j].begin(), found[j].end());
    if (*greatest / usual <= worst.ratio) continue;
    worst = {*greatest / usual, is_pelvis ? "(pelvis)" : clip.skeleton().joint(static_cast<int>(j)).name,
             static_cast<int>(greatest - found[j].begin()) + 1};
  }
  return worst;
}

struct Change {
  double moved = 0.0;    // of a toe, at most [cm]
  double shifted = 0.0;  // of the pelvis, at most [cm]
  double stretch = 0.0;  // of a leg bone, at most [%]
};

Change change(const Motion& before, const Motion& after, const motion::Legs& legs) {
  Change most;
  const auto pelvis = static_cast<std::size_t>(before.skeleton().pelvis());
  for (int t = 0; t < before.num_frames(); ++t) {
    const auto a = motion::forward_kinematics(before.skeleton(), before.frame(t));
    const auto b = motion::forward_kinematics(after.skeleton(), after.frame(t));
    most.shifted = std::max(most.shifted, 100.0 * (b.positions[pelvis] - a.positions[pelvis]).norm());
    for (const int foot : {0, 1}) {
      const motion::Leg& leg = legs.foot(foot);
      most.moved = std::max(most.moved, 100.0 * (motion::toe_position(leg, b) - motion::toe_position(leg, a)).norm());
      const auto knee = static_cast<std::size_t>(leg.knee);
      const double stretch = after.frame(t).translations[knee].norm() / before.frame(t).translations[knee].norm() - 1.0;
      most.stretch = std::max(most.stretch, 100.0 * stretch);
    }
  }
  return most;
}

struct Row {
  Figures before, after;
  Sharpest sharpest_before, sharpest_after;
  Change change;
  int let_go = 0;             // frames
  double microseconds = 0.0;  // a frame
};

double microseconds_per_frame(const Motion& clip, const motion::Legs& legs,
                              const std::vector<motion::Footplant>& plants) {
  std::vector<std::array<bool, 2>> planted(static_cast<std::size_t>(clip.num_frames()));
  for (const auto& plant : plants) {
    for (int t = plant.begin; t < plant.end; ++t)
      planted[static_cast<std::size_t>(t)][static_cast<std::size_t>(plant.foot)] = true;
  }
  postprocess::FootskateCleaner cleaner(clip.shared_skeleton(), legs, clip.frame_rate());
  Pose pose;
  double best = 1e9;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto begin = std::chrono::steady_clock::now();
    for (int t = 0; t < clip.num_frames(); ++t) cleaner.push(clip.frame(t), planted[static_cast<std::size_t>(t)], pose);
    const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - begin;
    best = std::min(best, spent.count() / clip.num_frames());
  }
  return best;
}

Row cleaned_row(const Motion& clip, const std::vector<motion::Footplant>& plants) {
  const auto legs = motion::find_legs(clip).value();
  Diagnostics diagnostics;
  const Motion cleaned = postprocess::clean_footskate(clip, legs, plants, {}, &diagnostics);
  const auto reference = accelerations(clip);
  Row row{slides(clip, plants),
          slides(cleaned, plants),
          sharpest(clip, reference, legs),
          sharpest(cleaned, reference, legs),
          change(clip, cleaned, legs),
          0,
          microseconds_per_frame(clip, legs, plants)};
  for (const auto& entry : diagnostics.entries())
    row.let_go += std::stoi(entry.message.substr(entry.message.find(" in ") + 4));
  return row;
}

Row cleaned_row(const Motion& clip) {
  return cleaned_row(clip, postprocess::detect_footplants(clip, motion::find_legs(clip).value()));
}

void print_head(const char* what) {
  std::printf(
      "| %s | in plants, cm/s: before, after, worst plant | anywhere, cm/s: before, after | sharpest joint: before, "
      "after | toe moved, cm | pelvis, cm | stretch, %% | let go, frames | us a frame |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      what);
}

void print(const std::string& name, const Row& row) {
  std::printf("| %s | %.1f, %.2f, %.2f | %.2f, %.2f | %.2f, %.2f (%s, frame %d) | %.1f | %.1f | %.2f | %d | %.2f |\n",
              name.c_str(), row.before.in_plants, row.after.in_plants, row.after.worst_plant, row.before.anywhere,
              row.after.anywhere, row.sharpest_before.ratio, row.sharpest_after.ratio, row.sharpest_after.joint.c_str(),
              row.sharpest_after.frame, row.change.moved, row.change.shifted, row.change.stretch, row.let_go,
              row.microseconds);
  std::fflush(stdout);
}

/// Means of slides and cost, the greatest of everything else.
Row together(const std::vector<Row>& rows) {
  Row all;
  const double share = 1.0 / static_cast<double>(rows.size());
  for (const Row& row : rows) {
    for (const auto& [sum, one] : {std::pair{&all.before, &row.before}, std::pair{&all.after, &row.after}}) {
      sum->in_plants += share * one->in_plants;
      sum->worst_plant = std::max(sum->worst_plant, one->worst_plant);
      sum->anywhere += share * one->anywhere;
    }
    all.sharpest_before.ratio = std::max(all.sharpest_before.ratio, row.sharpest_before.ratio);
    if (row.sharpest_after.ratio > all.sharpest_after.ratio) all.sharpest_after = row.sharpest_after;
    all.change.moved = std::max(all.change.moved, row.change.moved);
    all.change.shifted = std::max(all.change.shifted, row.change.shifted);
    all.change.stretch = std::max(all.change.stretch, row.change.stretch);
    all.let_go += row.let_go;
    all.microseconds += share * row.microseconds;
  }
  return all;
}

// ---- translated clips -----------------------------------------------------------------------------------------------

struct Takes {
  int first = 1, last = 8;
};

std::vector<Motion> read_takes(const std::string& data, const std::string& content, const std::string& style,
                               Takes takes) {
  std::vector<Motion> clips;
  for (int take = takes.first; take <= takes.last; ++take) {
    char name[200];
    std::snprintf(name, sizeof name, "/bandai-namco/dataset-2_%s_%s_%03d.bvh", content.c_str(), style.c_str(), take);
    if (std::filesystem::exists(data + name)) clips.push_back(read_bvh(data + name).motion);
  }
  return clips;
}

/// Slides of recorded takes: in their own plants, and anywhere.
Figures recorded(const std::vector<Motion>& takes) {
  Figures mean;
  for (const Motion& take : takes) {
    const auto found = slides(take, postprocess::detect_footplants(take, motion::find_legs(take).value()));
    mean.in_plants += found.in_plants / static_cast<double>(takes.size());
    mean.anywhere += found.anywhere / static_cast<double>(takes.size());
  }
  return mean;
}

void study_cells(const std::string& data, Takes learnt, Takes judged) {
  print_head("content, style (input in plants, style anywhere)");
  for (const char* content : {"walk", "walk-turn-left", "walk-turn-right", "run", "wave-left-hand", "wave-both-hands",
                              "raise-up-right-hand"}) {
    for (const char* style : {"elderly", "active", "feminine"}) {
      const auto inputs = read_takes(data, content, "normal", learnt),
                 outputs = read_takes(data, content, style, learnt);
      const auto model = learn_style(inputs, outputs, learn::find_pairs(inputs, outputs).pairs).model;
      const auto tested = read_takes(data, content, "normal", judged);
      std::vector<Row> rows;
      for (const Motion& take : tested)
        rows.push_back(cleaned_row(translate_motion(model, take, {.clean_feet = false})));
      const Figures input = recorded(tested), real = recorded(read_takes(data, content, style, judged));
      char name[200];
      std::snprintf(name, sizeof name, "%s %s (%.2f, %.2f)", content, style, input.in_plants, real.anywhere);
      print(name, together(rows));
    }
  }
}

// ---- generated walks ------------------------------------------------------------------------------------------------

/// The pelvis moves to and fro along the ground [m, Hz], as where root and legs are predicted apart.
Motion sliding(const Motion& clip, double amplitude, double frequency) {
  std::vector<Pose> frames = clip.frames();
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const double angle = 2.0 * std::numbers::pi * frequency * static_cast<double>(t) / clip.frame_rate();
    frames[t].translations[0] += amplitude * Vector3d(std::sin(angle), 0.0, std::cos(angle));
  }
  return {clip.shared_skeleton(), clip.frame_rate(), std::move(frames)};
}

void study_walks() {
  print_head("generated walk");
  for (const double rate : {30.0, 60.0, 120.0}) {
    const auto walk = generate::generate_walk({.duration = 8.0}, {}, rate);
    for (const double amplitude : {0.0, 0.01, 0.03}) {
      const Motion clip = sliding(walk.motion, amplitude, 1.0);
      char name[100];
      std::snprintf(name, sizeof name, "%.0f Hz, slides %.0f cm at 1 Hz", rate, 100.0 * amplitude);
      print(std::string(name) + ", its own footplants", cleaned_row(clip, walk.footplants));
      print(std::string(name) + ", the detector's", cleaned_row(clip));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) throw std::runtime_error("which data? See the top of this program's source");
    if (words[0] == "--walks") {
      study_walks();
    } else if (words[0] == "--clips") {
      print_head("clip");
      for (std::size_t i = 1; i < words.size(); ++i) {
        print(std::filesystem::path(words[i]).stem().string(), cleaned_row(read_bvh(words[i]).motion));
      }
    } else {
      const auto number = [&](std::size_t i, int usual) { return words.size() > i ? std::stoi(words[i]) : usual; };
      study_cells(words[0], {number(1, 1), number(2, 8)}, {number(3, 9), number(4, 12)});
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
