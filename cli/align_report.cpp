// SPDX-License-Identifier: MIT
#include "align_report.h"

#include "align_signals.h"

#include <algorithm>
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
      "mean ({:.1f} frames), {:.0f} ms at most{}; if stretched evenly {:.0f} ms\n",
      "footplants", found.num_pairs, found.onsets.size(), found.num_outputs(), found.mean * ms, found.mean,
      found.largest * ms, is_smoothed(a) ? fmt::format("; smoothed {:.0f} ms", a.smoothed.onsets->mean * ms) : "",
      a.even.onsets->mean * ms);
}

std::string objective_in_words(const Alignment& a) {
  const std::vector<double>& objective = a.answer.objective;
  if (!a.method->has_rounds && objective.size() > 1) {
    return fmt::format("  E falls from {:.4f} to {:.4f} in {} steps\n", objective.front(), objective.back(),
                       objective.size());
  }
  std::string text;
  for (std::size_t k = 0; k < objective.size(); ++k) {
    text += fmt::format("  E after round {:2}  {:14.4f}\n", k + 1, objective[k]);
  }
  return text;
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

/// Rows for the frames of a clip from `first` on, and their places in another.
std::string table(const char* other, double rate, Eigen::Index first, const align::Correspondence& found,
                  const Eigen::VectorXd& smoothed) {
  std::string csv =
      fmt::format("frame,time_s,{0}_frame,{0}_time_s,differential_warp,smoothed_differential_warp\n", other);
  const Eigen::VectorXd place = found.output_time();
  for (Eigen::Index t = 0; t < place.size(); ++t) {
    fmt::format_to(std::back_inserter(csv), "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", first + t,
                   static_cast<double>(first + t) / rate, place[t], place[t] / rate, found.differential_warp[t],
                   smoothed[t]);
  }
  return csv;
}

/// From a time of the output [frames] to that of the input, for times that rise from call to call.
class InverseWarp {
 public:
  explicit InverseWarp(const align::Correspondence& warp)
      : slope_(warp.differential_warp), passed_(warp.output_begin) {}

  double at(double output) {
    while (t_ + 1 < slope_.size() && passed_ + slope_[t_] < output) passed_ += slope_[t_++];
    return std::clamp(static_cast<double>(t_) + (output - passed_) / slope_[t_], 0.0,
                      static_cast<double>(slope_.size()));
  }

 private:
  const Eigen::VectorXd& slope_;
  double passed_;  ///< of the output before input frame t_
  Eigen::Index t_ = 0;
};

/// The inverse for the output frames [first, end): a warp from them into the input.
align::Correspondence inverse(const align::Correspondence& warp, Eigen::Index first, Eigen::Index end) {
  InverseWarp to_input(warp);
  align::Correspondence result{Eigen::VectorXd(end - first)};
  double last = result.output_begin = to_input.at(static_cast<double>(first));
  for (Eigen::Index j = first; j < end; ++j) {
    const double next = to_input.at(static_cast<double>(j + 1));
    result.differential_warp[j - first] = next - last;
    last = next;
  }
  result.output_rest = static_cast<double>(warp.differential_warp.size()) - last;
  return result;
}

}  // namespace

std::string clip_in_words(const char* role, const AlignClip& clip) {
  return fmt::format("{:7} {}: {} frames at {:g} frames/s, {:.2f} s\n", role, clip.path, clip.motion.num_frames(),
                     clip.motion.frame_rate(), clip.motion.duration());
}

std::string alignment_in_words(const Alignment& a, bool with_rounds) {
  std::string text = clip_in_words("output", a.output);
  text += fmt::format("aligned by {} on {}\n", a.method->title, signals_in_words(a.signals, num_compared(a)));
  if (with_rounds) text += objective_in_words(a);
  if (a.settings.time.ends != align::Ends::kFixed) {
    const double rate = a.input->motion.frame_rate();
    text += fmt::format("{:14} the input from {:.2f} to {:.2f} s of the output\n", "found",
                        a.found.warp.output_begin / rate, a.found.warp.output_end() / rate);
  }
  text += warp_in_words("warp", a.found.warp.differential_warp, a.slope_limit);
  if (is_smoothed(a)) text += warp_in_words("smoothed warp", a.smoothed.warp.differential_warp, a.slope_limit);
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
  Json json{{"output", clip_as_json(a.output)},
            {"method", a.method->name},
            {"signals", signals_name(a.signals)},
            {"degrees_of_freedom", num_compared(a)}};
  if (a.slope_limit > 0.0) json["slope_limit"] = a.slope_limit;
  if (!a.answer.objective.empty()) json["objective"] = a.answer.objective;
  json["output_begin_s"] = a.found.warp.output_begin / rate;
  json["output_end_s"] = a.found.warp.output_end() / rate;
  json["warp"] = warp_as_json(a.found.warp.differential_warp, a.slope_limit);
  json["smoothed_warp"] = warp_as_json(a.smoothed.warp.differential_warp, a.slope_limit);
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

std::string alignment_table(const Alignment& a) {
  return table("output", a.input->motion.frame_rate(), 0, a.found.warp, a.smoothed.warp.differential_warp);
}

std::string inverse_table(const Alignment& a) {
  // The output frames whose middles the input covers.
  const auto first = static_cast<Eigen::Index>(std::llround(a.found.warp.output_begin));
  const auto end = std::max(first + 1, static_cast<Eigen::Index>(std::llround(a.found.warp.output_end())));
  return table("input", a.input->motion.frame_rate(), first, inverse(a.found.warp, first, end),
               inverse(a.smoothed.warp, first, end).differential_warp);
}

}  // namespace strut::cli
