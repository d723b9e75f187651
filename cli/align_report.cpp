// SPDX-License-Identifier: MIT
#include "align_report.h"

#include <cmath>
#include <string>
#include <vector>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string warp_in_words(const char* what, const Eigen::VectorXd& slope, double slope_limit) {
  std::string text =
      fmt::format("{:14} {:.2f} to {:.2f} output frames per input frame", what, slope.minCoeff(), slope.maxCoeff());
  if (slope_limit > 0.0) {
    text += fmt::format(", {:.0f} % of the frames at the slope limit {:g}",
                        100.0 * align::share_at_slope_limit(slope, slope_limit), slope_limit);
  }
  return text + "\n";
}

std::string onsets_in_words(const Alignment& a) {
  if (!a.found.onsets) return fmt::format("{:14} none to judge by: {}\n", "footplants", a.no_plants);
  const OnsetErrors& found = *a.found.onsets;
  if (found.num_pairs == 0) return fmt::format("{:14} no foot comes down in both clips\n", "footplants");
  const double ms = 1e3 / a.input->motion.frame_rate();
  return fmt::format(
      "{:14} {} of the {} times a foot comes down in the input and of the {} in the output paired: {:.0f} ms off in "
      "the "
      "mean ({:.1f} frames), {:.0f} ms at most; smoothed {:.0f} ms; if stretched evenly {:.0f} ms\n",
      "footplants", found.num_pairs, found.onsets.size(), found.num_outputs(), found.mean * ms, found.mean,
      found.largest * ms, a.smoothed.onsets->mean * ms, a.even.onsets->mean * ms);
}

Json warp_as_json(const Eigen::VectorXd& slope, double slope_limit) {
  Json json{{"least", slope.minCoeff()}, {"most", slope.maxCoeff()}};
  if (slope_limit > 0.0) json["share_at_slope_limit"] = align::share_at_slope_limit(slope, slope_limit);
  return json;
}

Json onsets_as_json(const OnsetErrors& errors, double frame_rate) {
  Json json{{"paired", errors.num_pairs},
            {"unpaired_input", static_cast<int>(errors.onsets.size()) - errors.num_pairs},
            {"unpaired_output", errors.unpaired.size()}};
  if (errors.num_pairs == 0) return json;
  json["mean_error_s"] = errors.mean / frame_rate;
  json["largest_error_s"] = errors.largest / frame_rate;
  return json;
}

/// Rows for the frames of a clip and their places in another.
std::string table(const char* other, double rate, const JudgedWarp& found, const Eigen::VectorXd& smoothed) {
  std::string csv =
      fmt::format("frame,time_s,{0}_frame,{0}_time_s,differential_warp,smoothed_differential_warp\n", other);
  for (Eigen::Index t = 0; t < found.slope.size(); ++t) {
    fmt::format_to(std::back_inserter(csv), "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", t, static_cast<double>(t) / rate,
                   found.output_time[t], found.output_time[t] / rate, found.slope[t], smoothed[t]);
  }
  return csv;
}

}  // namespace

std::string clip_in_words(const char* role, const AlignClip& clip) {
  return fmt::format("{:7} {}: {} frames at {:g} frames/s, {:.2f} s\n", role, clip.path, clip.motion.num_frames(),
                     clip.motion.frame_rate(), clip.motion.duration());
}

std::string alignment_in_words(const Alignment& a, bool with_rounds) {
  std::string text = clip_in_words("output", a.output);
  text += fmt::format("aligned by {} on {} degrees of freedom\n", a.method->title, num_compared(a));
  for (std::size_t k = 0; with_rounds && k < a.answer.objective.size(); ++k) {
    text += fmt::format("  E after round {:2}  {:14.4f}\n", k + 1, a.answer.objective[k]);
  }
  text += warp_in_words("warp", a.found.slope, a.slope_limit);
  if (a.smoothed.slope != a.found.slope) text += warp_in_words("smoothed warp", a.smoothed.slope, a.slope_limit);
  return text + onsets_in_words(a);
}

Json clip_as_json(const AlignClip& clip) {
  return {{"path", clip.path},
          {"frames", clip.motion.num_frames()},
          {"frame_rate", clip.motion.frame_rate()},
          {"seconds", clip.motion.duration()}};
}

Json alignment_as_json(const Alignment& a) {
  const double rate = a.input->motion.frame_rate();
  Json json{{"output", clip_as_json(a.output)}, {"method", a.method->name}, {"degrees_of_freedom", num_compared(a)}};
  if (a.slope_limit > 0.0) json["slope_limit"] = a.slope_limit;
  if (!a.answer.objective.empty()) json["objective"] = a.answer.objective;
  json["warp"] = warp_as_json(a.found.slope, a.slope_limit);
  json["smoothed_warp"] = warp_as_json(a.smoothed.slope, a.slope_limit);
  if (a.found.onsets) {
    json["footplants"] = onsets_as_json(*a.found.onsets, rate);
    json["footplants_smoothed"] = onsets_as_json(*a.smoothed.onsets, rate);
    json["footplants_even_stretch"] = onsets_as_json(*a.even.onsets, rate);
  }
  json["warnings"] = Json::array();
  for (const Diagnostic& warning : a.warnings.entries()) {
    json["warnings"].push_back({{"path", warning.where}, {"message", warning.message}, {"hint", warning.hint}});
  }
  return json;
}

Eigen::VectorXd inverse_slope(const Eigen::VectorXd& slope) {
  const auto frames = static_cast<Eigen::Index>(std::llround(slope.sum()));
  Eigen::VectorXd inverse(frames);
  double passed = 0.0, last = 0.0;  // output frames before input frame t; input time at which output frame j begins
  Eigen::Index t = 0;
  for (Eigen::Index j = 0; j < frames; ++j) {
    while (t + 1 < slope.size() && passed + slope[t] < static_cast<double>(j + 1)) passed += slope[t++];
    const double end = j + 1 == frames ? static_cast<double>(slope.size())
                                       : static_cast<double>(t) + (static_cast<double>(j + 1) - passed) / slope[t];
    inverse[j] = end - last;
    last = end;
  }
  return inverse;
}

std::string alignment_table(const Alignment& a) {
  return table("output", a.input->motion.frame_rate(), a.found, a.smoothed.slope);
}

std::string inverse_table(const Alignment& a) {
  const Eigen::VectorXd slope = inverse_slope(a.found.slope);
  const JudgedWarp inverse{slope, align::Correspondence{slope}.output_time(), {}};
  return table("input", a.input->motion.frame_rate(), inverse, inverse_slope(a.smoothed.slope));
}

}  // namespace strut::cli
