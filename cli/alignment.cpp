// SPDX-License-Identifier: MIT
#include "alignment.h"

#include "align_signals.h"
#include "input_files.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::cli {
std::optional<std::vector<motion::Footplant>> plants_of(const AlignClip& clip, const FeetOptions& feet,
                                                        std::string& missing) {
  if (feet.left.empty() && !motion::find_legs(clip.motion)) {
    if (missing.empty()) missing = "no two legs were found in " + clip.path;
    return std::nullopt;
  }
  return postprocess::detect_footplants(clip.motion, legs_of(clip.path, clip.motion, feet));
}

AlignClip read_align_clip(const std::string& path, Diagnostics& diagnostics) {
  return align_clip(path, read_bvh(path, {}, &diagnostics).motion);
}

AlignClip align_clip(const std::string& path, Motion motion) {
  if (motion.num_frames() < 2) throw BadInput(path, "a clip to align needs at least two frames");
  return {path, std::move(motion)};
}

int num_compared(const Alignment& alignment) {
  Eigen::ArrayXd reach = alignment.features.input.cwiseAbs().colwise().maxCoeff().transpose().array();
  if (alignment.settings.time.weights.size() > 0) reach *= alignment.settings.time.weights.array();
  return static_cast<int>((reach > 0.0).count());
}

align::Correspondence smoothed(const align::Correspondence& warp, const AlignMethod& method,
                               const AlignOptions& options) {
  const double smoothness = options.warp_smoothness.value_or(method.warp_smoothness);
  return {align::smooth_differential_warp(warp.differential_warp, smoothness), warp.output_begin, warp.output_rest};
}

bool is_smoothed(const Alignment& alignment) {
  return alignment.smoothed.warp.differential_warp != alignment.found.warp.differential_warp;
}

const AlignMethod& method_of(const AlignOptions& options) {
  const align::Ends ends = options.settings.time.ends;
  if (!options.method) return default_method(ends);
  const AlignMethod& method = align_methods()[static_cast<std::size_t>(*options.method)];
  if (ends != align::Ends::kFixed && !method.opens_ends) {
    throw InvalidArgument("--ends", std::string("fixed with --method ") + method.name, "open ones",
                          "imw and timewarp can look for a clip inside another");
  }
  return method;
}

SignalSet signals_of(const AlignOptions& options, const AlignMethod& method) {
  const SignalSet set = options.signals ? static_cast<SignalSet>(*options.signals) : method.signals;
  if (options.shared_units && set != SignalSet::kPosture) {
    throw InvalidArgument("--shared-units", "--signals posture beside it", "all signals",
                          "movement and feet are compared in each clip's own units");
  }
  return set;
}

void make_comparable(AlignClip& clip, const AlignClip& reference, Diagnostics& diagnostics) {
  check_same_skeleton(clip.path, clip.motion.skeleton(), reference.path, reference.motion.skeleton());
  const double rate = reference.motion.frame_rate();
  if (clip.motion.frame_rate() == rate) return;
  diagnostics.note(clip.path, fmt::format("resampled from {:g} to {:g} frames/s, the rate of {}",
                                          clip.motion.frame_rate(), rate, reference.path));
  clip.motion = motion::resample(clip.motion, rate);
}

AlignAnswer solve(const Alignment& alignment, const AlignMethod& method) {
  return naming_the_file(alignment.output.path, [&] { return method.solve(alignment.features, alignment.settings); });
}

JudgedWarp judge(const Alignment& alignment, const align::Correspondence& warp) {
  JudgedWarp judged{warp, warp.output_time(), {}};
  if (alignment.plants.input && alignment.plants.output) {
    judged.onsets = onset_errors(*alignment.plants.input, *alignment.plants.output, judged.output_time);
  }
  return judged;
}

Alignment align_clips(const AlignClip& input, AlignClip output, const AlignOptions& options, Diagnostics& diagnostics) {
  make_comparable(output, input, diagnostics);
  Alignment a{.input = &input, .output = std::move(output)};
  a.method = &method_of(options);
  a.signals = signals_of(options, *a.method);
  a.settings = options.settings;
  a.settings.frame_rate = input.motion.frame_rate();
  a.slope_limit = a.method->slope_limit(a.settings);
  AlignSignals signals = signals_of({&input, &a.output}, a.signals, options);
  a.features = {std::move(signals.clips.front()), std::move(signals.clips.back())};
  a.settings.time.weights = std::move(signals.weights);
  a.plants.input = plants_of(input, options.feet, a.no_plants);
  a.plants.output = plants_of(a.output, options.feet, a.no_plants);
  a.answer = solve(a, *a.method);
  const align::Correspondence& found = a.answer.correspondence;
  a.found = judge(a, found);
  a.smoothed = judge(a, smoothed(found, *a.method, options));
  const Eigen::Index frames = found.differential_warp.size();
  a.even = judge(
      a, {Eigen::VectorXd::Constant(frames, found.differential_warp.mean()), found.output_begin, found.output_rest});
  if (!a.answer.is_exact) {
    diagnostics.note(a.output.path, "so long a pair is searched coarse to fine: the warp need not be the best of all");
  }
  a.warnings = warnings_of(a);
  diagnostics.append(a.warnings);
  return a;
}

}  // namespace strut::cli
