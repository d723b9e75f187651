// SPDX-License-Identifier: MIT
// What is to be doubted of an alignment: pairs that were hardly the same content, clips too short to tell, answers that
// are as good elsewhere. None of it is an error; all of it is worth a look at the figure.
#include "alignment.h"

#include <algorithm>
#include <cmath>

namespace strut::cli {
namespace {

constexpr double kMostAtLimit = 0.5;   // share of the frames along the slope limit that a good pair hardly has
constexpr double kForcedBy = 0.9;      // of the slope limit: lengths that differ so much leave the path no choice
constexpr double kLongestStall = 0.5;  // [s] a moment that lasts longer in the other clip is none
constexpr double kWholeCycle = 0.9;    // a clip shorter than this share of a gait cycle is not one
constexpr int kFewestOnsets = 4;       // to call an alignment worse than none
constexpr double kNearlyAlike = 1.3;   // times the distance at the place found: another place that may be meant
constexpr double kMostCompared = 200;  // input frames looked at for that

void warn_of_lengths(const Alignment& a, Diagnostics& warnings) {
  const double slope = a.even.warp.differential_warp[0];
  const double ratio = std::max(slope, 1.0 / slope);
  if (a.settings.time.ends != align::Ends::kFixed || a.slope_limit == 0.0 || ratio < kForcedBy * a.slope_limit ||
      a.slope_limit == 1.0)
    return;
  warnings.warn(a.output.path,
                fmt::format("one clip lasts {:.2f} times as long as the other: a slope limit of {:g} leaves the warp "
                            "hardly a choice",
                            ratio, a.slope_limit),
                "raise --slope-limit, or cut the clips to the same content");
}

void warn_of_limit(const Alignment& a, Diagnostics& warnings) {
  if (a.slope_limit == 0.0 || a.slope_limit == 1.0) return;
  const double share = align::share_at_slope_limit(a.smoothed.warp.differential_warp, a.slope_limit);
  if (share <= kMostAtLimit) return;
  warnings.warn(a.output.path,
                fmt::format("the warp runs along the slope limit {:g} for {:.0f} % of the frames{}", a.slope_limit,
                            100.0 * share, is_smoothed(a) ? " even after smoothing" : ""),
                "the clips may not be of the same content; raise --slope-limit if they are");
}

void warn_of_stalls(const Alignment& a, Diagnostics& warnings) {
  if (a.slope_limit > 0.0) return;
  const Eigen::VectorXd& slope = a.found.warp.differential_warp;
  const double longest = std::max(slope.maxCoeff(), 1.0 / slope.minCoeff());
  if (longest < kLongestStall * a.input->motion.frame_rate()) return;
  warnings.warn(a.output.path,
                fmt::format("one frame of one clip belongs to {:.0f} frames ({:.2f} s) of the other", longest,
                            longest / a.input->motion.frame_rate()),
                "the clips may not be of the same content; a method with a slope limit does not stand still");
}

void warn_of_short_clips(const Alignment& a, Diagnostics& warnings) {
  if (!a.plants.input || !a.plants.output) return;
  const double in = cycle_length(*a.plants.input), out = cycle_length(*a.plants.output);
  const auto check = [&](const AlignClip& clip, double cycle) {
    const double frames = clip.motion.num_frames();
    if (cycle == 0.0 || frames >= kWholeCycle * cycle) return;
    warnings.warn(clip.path,
                  fmt::format("is shorter ({:.2f} s) than a gait cycle ({:.2f} s)", frames / clip.motion.frame_rate(),
                              cycle / clip.motion.frame_rate()),
                  "its first and last frames decide what belongs together; see that both clips begin at the same "
                  "moment of the gait");
  };
  check(*a.input, in > 0.0 ? in : out);
  check(a.output, out > 0.0 ? out : in);
}

void warn_of_footplants(const Alignment& a, Diagnostics& warnings) {
  if (!a.found.onsets || a.found.onsets->num_pairs < kFewestOnsets) return;
  const double mean = a.smoothed.onsets->mean, even = a.even.onsets->mean;
  const double frame_ms = 1e3 / a.input->motion.frame_rate();
  if (mean <= even + 0.5 || a.even.onsets->num_pairs < a.smoothed.onsets->num_pairs) return;
  warnings.warn(a.output.path,
                fmt::format("footplants are {:.0f} ms from where the alignment puts them, and {:.0f} ms if the input "
                            "is stretched evenly",
                            mean * frame_ms, even * frame_ms),
                "look at --plot before relying on it");
}

/// The mean squared distance of the input to the output where the warp puts it, moved on by `offset` frames.
double distance_at(const Alignment& a, Eigen::Index offset) {
  const auto& [input, output] = a.features;
  const Eigen::VectorXd& weights = a.settings.time.weights;
  const auto every = 1 + static_cast<Eigen::Index>(static_cast<double>(input.rows()) / kMostCompared);
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index t = 0; t < input.rows(); t += every, ++count) {
    const auto place = static_cast<Eigen::Index>(std::lround(a.found.output_time[t])) + offset;
    const auto difference = (input.row(t) - output.row(place)).cwiseAbs2();
    sum += weights.size() > 0 ? difference.dot(weights.transpose()) : difference.sum();
  }
  return sum / count;
}

/// Where the ends are open and movement repeats itself, as in walking, the place found is one of several.
void warn_of_other_places(const Alignment& a, Diagnostics& warnings) {
  if (a.settings.time.ends == align::Ends::kFixed) return;
  const auto begin = static_cast<Eigen::Index>(std::lround(a.found.output_time[0]));
  const auto last = static_cast<Eigen::Index>(std::lround(a.found.output_time[a.found.output_time.size() - 1]));
  const Eigen::Index apart = std::max<Eigen::Index>((last - begin) / 2, 1);
  const double bound = kNearlyAlike * distance_at(a, 0);
  double least = bound;
  Eigen::Index best = 0;
  for (Eigen::Index offset = -begin; offset < a.features.output.rows() - last; ++offset) {
    if (std::abs(offset) < apart) continue;
    const double distance = distance_at(a, offset);
    if (distance > least) continue;
    least = distance;
    best = offset;
  }
  if (best == 0) return;
  const double rate = a.input->motion.frame_rate();
  warnings.warn(a.output.path,
                fmt::format("from {:.2f} s on it is nearly as like the input as from {:.2f} s on, where it was found",
                            static_cast<double>(begin + best) / rate, static_cast<double>(begin) / rate),
                "movement that repeats itself, as walking does, fits at several places; give more of it, or cut the "
                "output");
}

}  // namespace

Diagnostics warnings_of(const Alignment& alignment) {
  Diagnostics warnings;
  for (const auto warn : {warn_of_lengths, warn_of_limit, warn_of_stalls, warn_of_short_clips, warn_of_footplants,
                          warn_of_other_places}) {
    warn(alignment, warnings);
  }
  return warnings;
}

}  // namespace strut::cli
