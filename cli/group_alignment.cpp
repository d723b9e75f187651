// SPDX-License-Identifier: MIT
#include "group_alignment.h"

#include "align_report.h"
#include "align_signals.h"
#include "input_files.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include <strut/align/warp_curve.h>
#include <strut/core/error.h>

namespace strut::cli {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Json = nlohmann::ordered_json;

constexpr int kMostRounds = 24;         // smooth curves settle later than counts: 7 to 17 rounds on recorded clips
constexpr double kPlainlyLess = 0.999;  // of a spread: what figures in words show

/// The options that only go with two clips.
void check(const AlignOptions& options) {
  const auto refuse = [](const char* option, const char* got) {
    throw InvalidArgument(option, "none with --groupwise", got, "align two of the clips for it");
  };
  if (!options.plot.empty()) refuse("--plot", "a figure, which is of two clips");
  if (options.shared_units) refuse("--shared-units", "one unit; every clip of a group is compared in its own");
  if (options.settings.time.ends != align::Ends::kFixed) {
    throw InvalidArgument("--ends", "fixed with --groupwise", "open ones",
                          "the timeline begins and ends where all clips do");
  }
}

/// Passes on what aligning refuses of "clip K" as the fault of that clip's file.
[[noreturn]] void refuse_one_of(const std::vector<AlignClip>& clips, const InvalidArgument& error) {
  constexpr std::string_view kClip = "clip ";
  const std::string what = error.what();
  std::size_t k = clips.size();
  if (what.starts_with(kClip)) std::from_chars(what.data() + kClip.size(), what.data() + what.size(), k);
  if (k >= clips.size()) throw error;
  const std::string reason = what.substr(what.find(": ") + 2);
  throw BadInput(clips[k].path, "does not fit the timeline: " + reason.substr(reason.find(": ") + 2), error.hint());
}

align::GroupAlignment found_by(const GroupAlignment& group, const AlignSignals& signals, AlignSettings settings,
                               const AlignOptions& options) {
  settings.time.weights = signals.weights;
  settings.frame_rate = group.frame_rate();
  const AlignMethod& method = *group.method;
  align::GroupOptions how;
  how.max_rounds = kMostRounds;
  how.aligner = [&](const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output) {
    return smoothed(method.solve({input, output}, settings).correspondence, method, options);
  };
  try {
    return align::align_group(signals.clips, how);
  } catch (const InvalidArgument& error) {
    refuse_one_of(group.clips, error);
  }
}

int num_moving(const AlignSignals& signals) {
  Eigen::ArrayXd reach = Eigen::ArrayXd::Zero(signals.clips.front().cols());
  for (const FrameMatrix& clip : signals.clips) {
    reach = reach.max(clip.cwiseAbs().colwise().maxCoeff().transpose().array());
  }
  if (signals.weights.size() > 0) reach *= signals.weights.array();
  return static_cast<int>((reach > 0.0).count());
}

using Plants = std::vector<std::vector<motion::Footplant>>;

/// Over all pairs of clips; `through(i, j)`: the times of clip j at the frames of clip i.
template <typename Through>
GroupOnsets onsets_of(const Plants& plants, double frame_rate, Through through) {
  GroupOnsets all;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    for (std::size_t j = i + 1; j < plants.size(); ++j) {
      const OnsetErrors errors = onset_errors(plants[i], plants[j], through(i, j));
      all.num_onsets += static_cast<int>(errors.onsets.size());
      all.num_pairs += errors.num_pairs;
      all.mean += errors.mean * errors.num_pairs / frame_rate;
    }
  }
  if (all.num_pairs > 0) all.mean /= all.num_pairs;
  return all;
}

void add_onsets(GroupAlignment& group, const FeetOptions& feet) {
  Plants plants;
  for (const AlignClip& clip : group.clips) {
    auto own = plants_of(clip, feet, group.no_plants);
    if (!own) return;
    plants.push_back(std::move(*own));
  }
  std::vector<align::Correspondence> inverses;
  for (const align::Correspondence& clip : group.found.clips) inverses.push_back(align::inverse(clip));
  group.onsets = onsets_of(plants, group.frame_rate(), [&](std::size_t i, std::size_t j) {
    return align::compose(inverses[i], group.found.clips[j]).output_time();
  });
  group.even = onsets_of(plants, group.frame_rate(), [&](std::size_t i, std::size_t j) {
    const int frames = group.clips[i].motion.num_frames();
    const double slope = static_cast<double>(group.clips[j].motion.num_frames()) / frames;
    return align::Correspondence{VectorXd::Constant(frames, slope)}.output_time();
  });
}

std::string onsets_in_words(const GroupAlignment& group) {
  if (!group.onsets) return fmt::format("{:14} none to judge by: {}\n", "footplants", group.no_plants);
  const GroupOnsets& found = *group.onsets;
  if (found.num_pairs == 0) return fmt::format("{:14} no foot comes down in two clips\n", "footplants");
  return fmt::format(
      "{:14} {} of {} times a foot comes down paired, over all pairs of clips: {:.0f} ms apart in the mean; if "
      "stretched "
      "evenly {:.0f} ms\n",
      "footplants", found.num_pairs, found.num_onsets, 1e3 * found.mean, 1e3 * group.even->mean);
}

Json onsets_as_json(const GroupOnsets& onsets) {
  Json json{{"paired", onsets.num_pairs}, {"unpaired", onsets.num_onsets - onsets.num_pairs}};
  if (onsets.num_pairs > 0) json["mean_error_s"] = onsets.mean;
  return json;
}

std::string table(const char* other, double rate, const align::Correspondence& warp) {
  std::string csv = fmt::format("frame,time_s,{0}_frame,{0}_time_s,differential_warp\n", other);
  const VectorXd place = warp.output_time();
  for (Index t = 0; t < place.size(); ++t) {
    fmt::format_to(std::back_inserter(csv), "{},{:.6f},{:.6f},{:.6f},{:.6f}\n", t, static_cast<double>(t) / rate,
                   place[t], place[t] / rate, warp.differential_warp[t]);
  }
  return csv;
}

}  // namespace

GroupAlignment align_clips_groupwise(std::vector<AlignClip> clips, const AlignOptions& options,
                                     Diagnostics& diagnostics) {
  check(options);
  for (AlignClip& clip : clips) make_comparable(clip, clips.front(), diagnostics);
  GroupAlignment group{.clips = std::move(clips)};
  group.method = &method_of(options);
  group.signals = signals_of(options, *group.method);
  group.slope_limit = group.method->slope_limit(options.settings);
  std::vector<const AlignClip*> all;
  for (const AlignClip& clip : group.clips) all.push_back(&clip);
  const AlignSignals signals = signals_of(all, group.signals, options);
  group.num_compared = num_moving(signals);
  group.found = found_by(group, signals, options.settings, options);
  add_onsets(group, options.feet);
  if (!group.found.converged) {
    diagnostics.warn(
        "timeline",
        fmt::format(
            "a moment still moved by {:.2f} frames in the last of {} rounds; the round of least spread is given",
            group.found.moved, group.found.spread.size()),
        "the clips may not be of the same content");
  }
  return group;
}

std::string group_in_words(const GroupAlignment& group) {
  std::string text;
  for (const AlignClip& clip : group.clips) text += clip_in_words("clip", clip);
  const Index frames = group.found.mean.rows();
  const std::vector<double>& spread = group.found.spread;
  text +=
      fmt::format("aligned by {} on {}\n", group.method->title, signals_in_words(group.signals, group.num_compared));
  text +=
      fmt::format("{:14} {} frames, {:.2f} s\n", "timeline", frames, static_cast<double>(frames) / group.frame_rate());
  text += fmt::format("{:14} {}, {}\n", "rounds", spread.size(), group.found.converged ? "converged" : "not converged");
  text +=
      fmt::format("{:14} {:.4f} after the first round, {:.4f} after the last", "spread", spread.front(), spread.back());
  const double least = *std::min_element(spread.begin(), spread.end());
  text += least < kPlainlyLess * spread.back() ? fmt::format("; that of least, {:.4f}, is kept\n", least) : "\n";
  for (std::size_t k = 0; k < group.clips.size(); ++k) {
    const VectorXd& slope = group.found.clips[k].differential_warp;
    text += fmt::format("{:14} {:.2f} to {:.2f} frames of {} per timeline frame\n", "warp", slope.minCoeff(),
                        slope.maxCoeff(), group.clips[k].path);
  }
  return text + onsets_in_words(group);
}

Json group_as_json(const GroupAlignment& group) {
  const Index frames = group.found.mean.rows();
  Json json{{"timeline",
             {{"frames", frames},
              {"frame_rate", group.frame_rate()},
              {"seconds", static_cast<double>(frames) / group.frame_rate()}}},
            {"method", group.method->name},
            {"signals", signals_name(group.signals)},
            {"degrees_of_freedom", group.num_compared},
            {"rounds", group.found.spread.size()},
            {"spread", group.found.spread},
            {"moved_s", group.found.moved / group.frame_rate()},
            {"converged", group.found.converged}};
  if (group.slope_limit > 0.0) json["slope_limit"] = group.slope_limit;
  json["clips"] = Json::array();
  for (std::size_t k = 0; k < group.clips.size(); ++k) {
    const VectorXd& slope = group.found.clips[k].differential_warp;
    Json clip = clip_as_json(group.clips[k]);
    clip["warp"] = {{"least", slope.minCoeff()}, {"most", slope.maxCoeff()}};
    json["clips"].push_back(std::move(clip));
  }
  if (group.onsets) {
    json["footplants"] = onsets_as_json(*group.onsets);
    json["footplants_even_stretch"] = onsets_as_json(*group.even);
  }
  return json;
}

std::string group_table(const GroupAlignment& group, std::size_t clip) {
  return table("clip", group.frame_rate(), group.found.clips[clip]);
}

std::string group_inverse_table(const GroupAlignment& group, std::size_t clip) {
  return table("timeline", group.frame_rate(), align::inverse(group.found.clips[clip]));
}

}  // namespace strut::cli
