// SPDX-License-Identifier: MIT
// How well do iterative motion warping, its time-warp stage alone, and dynamic time warping find a correspondence that
// is known exactly? Walks of one content in two styles, made by generate/walker.h; prints the tables of
// docs/correspondence.md. With two file names it also writes a pair of these walks, from which `strut align` draws that
// page's figure:  correspondence_study [input.bvh output.bvh]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>
#include <strut/representation/alignment_features.h>

namespace {

using namespace strut;
using generate::WalkContent;
using generate::WalkStyle;

constexpr double kRate = 30.0;
constexpr int kSeeds = 5;
constexpr int kSlopeLimit = 2;
constexpr double kVariation = 2.5;    // of steps: about 5 % of length and time, in each motion by itself
constexpr double kSmoothness = 10.0;  // of the differential warp, as learning smooths it [frames^2]

// ---- what is walked -------------------------------------------------------------------------------------------------

struct NamedStyle {
  const char* name;
  WalkStyle style;
};

std::vector<NamedStyle> styles() {
  WalkStyle crouch;
  crouch.crouch = 0.25;
  crouch.cadence_scale = 0.8;
  crouch.torso_lean = 0.5;
  crouch.arm_swing = 0.1;
  crouch.elbow_bend = 1.0;
  WalkStyle limp;
  limp.limp = 1.0;
  limp.cadence_scale = 0.85;
  limp.step_length_scale = 0.8;
  WalkStyle march;
  march.foot_lift = 0.25;
  march.arm_swing = 0.9;
  march.cadence_scale = 1.1;
  march.heel_strike = 0.0;
  WalkStyle old;
  old.step_length_scale = 0.55;
  old.cadence_scale = 0.75;
  old.torso_lean = 0.35;
  old.arm_swing = 0.12;
  old.elbow_bend = 0.7;
  old.push_off = 0.45;
  WalkStyle swagger;
  swagger.hip_sway = 2.2;
  swagger.hip_twist = 2.0;
  swagger.arm_spread = 0.35;
  swagger.arm_swing = 0.6;
  swagger.cadence_scale = 0.9;
  swagger.bounce = 1.6;
  WalkStyle hurry;
  hurry.cadence_scale = 1.5;
  hurry.torso_lean = 0.2;
  hurry.elbow_bend = 1.4;
  hurry.arm_swing = 0.7;
  return {{"crouch", crouch}, {"limp", limp}, {"march", march}, {"old", old}, {"swagger", swagger}, {"hurry", hurry}};
}

/// Straight at two speeds, a turn, and a change of pace with the path bending after it.
std::vector<WalkContent> contents() {
  using generate::Schedule;
  WalkContent steady, slow, turn, pace;
  for (WalkContent* content : {&steady, &slow, &turn, &pace}) content->duration = 4.0;
  slow.speed = 0.8;
  turn.turn_rate = 0.6;
  pace.speed = Schedule({{0.0, 0.8}, {1.5, 0.8}, {2.5, 1.6}});
  pace.turn_rate = Schedule({{2.0, 0.0}, {3.0, -0.5}});
  return {steady, slow, turn, pace};
}

struct Pair {
  const char* style;
  generate::Walk input, output;
};

std::vector<Pair> pairs() {
  std::vector<Pair> all;
  std::uint64_t seed = 1;
  for (const auto& [name, style] : styles()) {
    for (const WalkContent& content : contents()) {
      for (int k = 0; k < kSeeds; ++k) {
        WalkStyle plain, styled = style;
        plain.seed = seed++;
        styled.seed = seed++;
        plain.variation = styled.variation = kVariation;
        all.push_back({name, generate::generate_walk(content, plain, kRate), generate_walk(content, styled, kRate)});
      }
    }
  }
  return all;
}

// ---- how it is aligned ----------------------------------------------------------------------------------------------

using Signals = representation::AlignmentPair;
using Warp = Eigen::VectorXd;

Warp imw(const Signals& s) {
  return align::iterative_motion_warping(s.input, s.output).correspondence.differential_warp;
}
Warp time_warp(const Signals& s) {
  return align::time_warp(s.input, s.output, {.slope_limit = kSlopeLimit}).correspondence().differential_warp;
}
Warp dtw(const Signals& s, align::LocalConstraint constraint) {
  return align::dynamic_time_warping(s.input, s.output, constraint).correspondence.differential_warp;
}
Warp uniform(const Signals& s) {
  return Warp::Constant(s.input.rows(), static_cast<double>(s.output.rows()) / static_cast<double>(s.input.rows()));
}
Warp smoothed(const Warp& warp) {
  return align::smooth_differential_warp(warp, kSmoothness);
}

struct Method {
  const char* name;
  std::function<Warp(const Signals&)> solve;
};

const std::vector<Method>& methods() {
  using align::LocalConstraint;
  static const std::vector<Method> all{
      {"IMW", imw},
      {"time-warp stage alone", time_warp},
      {"DTW, Type I", [](const Signals& s) { return dtw(s, LocalConstraint::kTypeI); }},
      {"DTW, Type III", [](const Signals& s) { return dtw(s, LocalConstraint::kTypeIII); }},
      {"IMW, smoothed", [](const Signals& s) { return smoothed(imw(s)); }},
      {"time-warp stage alone, smoothed", [](const Signals& s) { return smoothed(time_warp(s)); }},
      {"DTW, Type I, smoothed", [](const Signals& s) { return smoothed(dtw(s, LocalConstraint::kTypeI)); }},
      {"DTW, Type III, smoothed", [](const Signals& s) { return smoothed(dtw(s, LocalConstraint::kTypeIII)); }},
      {"no alignment: uniform", uniform},
  };
  return all;
}

// ---- what comes out -------------------------------------------------------------------------------------------------

struct Figures {
  std::vector<double> errors;  ///< of every frame [frames]
  double squared_steps = 0.0;  ///< summed squared change of the differential warp from frame to frame
  double at_limit = 0.0;       ///< frames
  void add(const Warp& warp, const std::vector<double>& truth) {
    const Eigen::VectorXd time = align::Correspondence{warp}.output_time();
    for (Eigen::Index t = 0; t < time.size(); ++t) {
      errors.push_back(std::abs(time[t] - truth[static_cast<std::size_t>(t)]));
    }
    squared_steps += (warp.tail(warp.size() - 1) - warp.head(warp.size() - 1)).squaredNorm();
    at_limit += align::share_at_slope_limit(warp, kSlopeLimit) * static_cast<double>(warp.size());
  }
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double error : errors) sum += error;
    return sum / static_cast<double>(errors.size());
  }
  [[nodiscard]] double percentile_95() const {
    std::vector<double> sorted = errors;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(0.95 * static_cast<double>(sorted.size() - 1))];
  }
  [[nodiscard]] double roughness() const { return std::sqrt(squared_steps / static_cast<double>(errors.size())); }
  [[nodiscard]] double share_at_limit() const { return at_limit / static_cast<double>(errors.size()); }
};

Warp true_warp(const std::vector<double>& truth) {
  const auto n = static_cast<Eigen::Index>(truth.size());
  const Eigen::Map<const Eigen::VectorXd> time(truth.data(), n);
  return time.tail(n - 1) - time.head(n - 1);
}

void print_row(const char* name, const Figures& all) {
  std::printf("| %s | %.2f | %.2f | %.3f | %.0f %% |\n", name, all.mean(), all.percentile_95(), all.roughness(),
              100.0 * all.share_at_limit());
}

void print_tables(const char* heading, const std::vector<Pair>& all, representation::StyleUnits units) {
  const auto& columns = methods();
  std::vector<Figures> overall(columns.size());
  std::vector<std::pair<std::string, std::vector<Figures>>> by_style;
  for (const Pair& pair : all) {
    if (by_style.empty() || by_style.back().first != pair.style) {
      by_style.emplace_back(pair.style, std::vector<Figures>(columns.size()));
    }
    const Signals signals = representation::alignment_features(pair.input.motion, pair.output.motion, units);
    const std::vector<double> truth = generate::true_correspondence(pair.input, pair.output);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const Warp warp = columns[k].solve(signals);
      overall[k].add(warp, truth);
      by_style.back().second[k].add(warp, truth);
    }
  }
  std::printf("\n### %s\n\n", heading);
  std::printf("| method | mean error [frames] | 95th percentile [frames] | roughness | at the slope limit |\n");
  std::printf("| --- | ---: | ---: | ---: | ---: |\n");
  for (std::size_t k = 0; k < columns.size(); ++k) print_row(columns[k].name, overall[k]);

  std::printf("\nMean error [frames] by style:\n\n| style |");
  for (std::size_t k = 0; k < 4; ++k) std::printf(" %s |", columns[k].name);
  std::printf(" uniform |\n| --- | ---: | ---: | ---: | ---: | ---: |\n");
  for (const auto& [style, figures] : by_style) {
    std::printf("| %s |", style.c_str());
    for (std::size_t k = 0; k < 4; ++k) std::printf(" %.2f |", figures[k].mean());
    std::printf(" %.2f |\n", figures.back().mean());
  }
}

void print_truth(const std::vector<Pair>& all) {
  Figures truth;
  std::size_t frames = 0;
  for (const Pair& pair : all) {
    const std::vector<double> times = generate::true_correspondence(pair.input, pair.output);
    const Warp warp = true_warp(times);
    truth.squared_steps += (warp.tail(warp.size() - 1) - warp.head(warp.size() - 1)).squaredNorm();
    truth.at_limit += align::share_at_slope_limit(warp, kSlopeLimit) * static_cast<double>(warp.size());
    frames += times.size();
  }
  truth.errors.assign(frames, 0.0);
  std::printf("%zu pairs, %zu frames. The true warp's roughness is %.3f; %.0f %% of it is at the slope limit.\n",
              all.size(), frames, truth.roughness(), 100.0 * truth.share_at_limit());
}

void write_clips(const Pair& pair, const char* input, const char* output) {
  const BvhLayout layout = default_layout(pair.input.motion.skeleton());
  write_bvh(input, pair.input.motion, layout, Overwrite::kAllow);
  write_bvh(output, pair.output.motion, layout, Overwrite::kAllow);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<Pair> all = pairs();
    if (argc == 3) {
      write_clips(all.front(), argv[1], argv[2]);
      return 0;
    }
    print_truth(all);
    print_tables("Each motion in units of its own style, as `strut learn` aligns", all,
                 representation::StyleUnits::kOwn);
    print_tables("Postures as they are: one mean and unit for both", all, representation::StyleUnits::kShared);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "correspondence_study: %s\n", error.what());
    return 1;
  }
}
