// SPDX-License-Identifier: MIT
// Nearest neighbours in a few features. Speed, duration and movement are compared in deviations of each style's own
// values: the fast walk of a slow style belongs to the fast walk of a quick one.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <strut/core/error.h>
#include <strut/learn/clip_pair.h>

namespace strut::learn {
namespace {

// Durations farther apart than this take a slope limit of 3, and beyond that limit cannot be aligned.
constexpr double kWideRatio = 1.8;
constexpr double kLargestRatio = 3.0;
// Deviations smaller than these are noise and not scaled up: speed [m/s], logarithm of duration, movement [m].
constexpr double kLeastSpeedDeviation = 0.03;
constexpr double kLeastDurationDeviation = 0.03;
constexpr double kLeastMovementDeviation = 0.005;
// Of the features of whole clips: of like takes the amount of movement says less than their length.
constexpr double kMovementWeight = 0.5;
// A whole clip shorter or longer than its style's median by this factor is not one of its kind.
constexpr double kOutlierRatio = 3.0;

// Stretches whose turning differs by more than this many scales are not of one action.
constexpr double kLargestTurningDifference = 2.0;
constexpr double kDegrees = 180.0 / std::numbers::pi;

using Values = std::vector<double>;

/// Where a style's values lie.
struct Spread {
  double centre = 0.0, deviation = 1.0;

  [[nodiscard]] double score(double value) const { return (value - centre) / deviation; }
};

Spread spread_of(const Values& values, double least_deviation) {
  if (values.empty()) return {};
  Spread spread;
  for (const double value : values) spread.centre += value / static_cast<double>(values.size());
  double variance = 0.0;
  for (const double value : values) {
    variance += (value - spread.centre) * (value - spread.centre) / static_cast<double>(values.size());
  }
  spread.deviation = std::max(std::sqrt(variance), least_deviation);
  return spread;
}

/// The spreads of one style's stretches of one kind.
struct StyleSpread {
  Spread speed, log_duration, movement;
};

StyleSpread style_spread(const std::vector<Stretch>& stretches, PairKind kind) {
  Values speeds, durations, movements;
  for (const Stretch& stretch : stretches) {
    if (stretch.kind != kind) continue;
    speeds.push_back(stretch.features.speed);
    durations.push_back(std::log(stretch.features.duration));
    movements.push_back(stretch.features.movement);
  }
  return {spread_of(speeds, kLeastSpeedDeviation), spread_of(durations, kLeastDurationDeviation),
          spread_of(movements, kLeastMovementDeviation)};
}

/// Distances between the stretches of two styles.
class Matcher {
 public:
  Matcher(const std::vector<Stretch>& inputs, const std::vector<Stretch>& outputs, PairKind kind,
          const PairingOptions& options)
      : options_(options), kind_(kind), input_(style_spread(inputs, kind)), output_(style_spread(outputs, kind)) {}

  [[nodiscard]] double distance(const PairFeatures& a, const PairFeatures& b) const {
    const double turning = (a.turning - b.turning) / options_.turning_scale;
    const double speed = options_.speed_weight * (input_.speed.score(a.speed) - output_.speed.score(b.speed));
    if (kind_ == PairKind::kGaitCycle) return std::hypot(turning, speed);
    const double duration =
        input_.log_duration.score(std::log(a.duration)) - output_.log_duration.score(std::log(b.duration));
    const double movement = kMovementWeight * (input_.movement.score(a.movement) - output_.movement.score(b.movement));
    return std::hypot(std::hypot(turning, speed), std::hypot(duration, movement));
  }

 private:
  const PairingOptions& options_;
  PairKind kind_;
  StyleSpread input_, output_;
};

std::string with_decimals(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// Why two stretches make no pair; empty if they do.
std::string refusal(const PairFeatures& a, const PairFeatures& b, const PairingOptions& options) {
  if (slope_limit_for(a.duration, b.duration) == 0) {
    return "one lasts " + with_decimals(std::max(a.duration, b.duration) / std::min(a.duration, b.duration), 1) +
           " times as long as the other (at most 3 can be aligned)";
  }
  if (std::abs(a.turning - b.turning) > kLargestTurningDifference * options.turning_scale) {
    return "one turns by " + with_decimals(kDegrees * a.turning, 0) + " degrees, the other by " +
           with_decimals(kDegrees * b.turning, 0);
  }
  return {};
}

ClipPair make_pair(const Stretch& input, const Stretch& output, double distance) {
  const int slope_limit = slope_limit_for(input.features.duration, output.features.duration);
  return {input.clip, output.clip,    input.frames,    output.frames, slope_limit, input.kind,
          input.foot, input.features, output.features, distance,      {}};
}

/// Every pair of one kind.
class PairsOfOneKind {
 public:
  PairsOfOneKind(Pairing& pairing, PairKind kind, const PairingOptions& options)
      : pairing_(pairing), kind_(kind), options_(options), matcher_(pairing.inputs, pairing.outputs, kind, options) {}

  void make() {
    for (const Stretch& input : pairing_.inputs) {
      if (input.kind == kind_) pair(input);
    }
  }

 private:
  struct Candidate {
    const Stretch* output;
    double distance;
  };

  [[nodiscard]] std::vector<Candidate> candidates(const Stretch& input) const {
    std::vector<Candidate> found;
    for (const Stretch& output : pairing_.outputs) {
      if (output.kind != kind_ || output.foot != input.foot) continue;
      found.push_back({&output, matcher_.distance(input.features, output.features)});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    return found;
  }

  void pair(const Stretch& input) {
    int made = 0;
    int refused = 0;
    for (const Candidate& candidate : candidates(input)) {
      if (made == options_.neighbours) break;
      const std::string reason = refusal(input.features, candidate.output->features, options_);
      if (reason.empty()) {
        ++made;
        pairing_.pairs.push_back(make_pair(input, *candidate.output, candidate.distance));
      } else if (refused++ < options_.neighbours) {
        pairing_.refused.push_back({input, *candidate.output, reason});
      }
    }
    if (made == 0) pairing_.uncovered.push_back(input);
  }

  Pairing& pairing_;
  PairKind kind_;
  const PairingOptions& options_;
  Matcher matcher_;
};

/// Takes out whole clips whose length is not of their style's kind: a recording that broke off.
void drop_outliers(std::vector<Stretch>& stretches, Diagnostics& diagnostics) {
  Values durations;
  for (const Stretch& stretch : stretches) {
    if (stretch.kind == PairKind::kWhole) durations.push_back(stretch.features.duration);
  }
  if (durations.size() < 3) return;
  std::nth_element(durations.begin(), durations.begin() + static_cast<std::ptrdiff_t>(durations.size() / 2),
                   durations.end());
  const double median = durations[durations.size() / 2];
  const auto is_outlier = [&](const Stretch& stretch) {
    const double ratio = stretch.features.duration / median;
    return stretch.kind == PairKind::kWhole && std::max(ratio, 1.0 / ratio) > kOutlierRatio;
  };
  for (const Stretch& stretch : stretches) {
    if (!is_outlier(stretch)) continue;
    diagnostics.warn("clip " + std::to_string(stretch.clip),
                     "left out: it moves for " + with_decimals(stretch.features.duration, 2) +
                         " s, its style's clips for " + with_decimals(median, 2) + " s in the middle");
  }
  stretches.erase(std::remove_if(stretches.begin(), stretches.end(), is_outlier), stretches.end());
}

/// The stretches of one style; reports say which style's clip they speak of.
std::vector<Stretch> stretches_of_style(const std::vector<Motion>& clips, const std::string& style,
                                        const PairingOptions& options, Diagnostics* diagnostics) {
  Diagnostics found;
  std::vector<Stretch> stretches = stretches_of(clips, options, &found);
  drop_outliers(stretches, found);
  if (diagnostics == nullptr) return stretches;
  for (const Diagnostic& entry : found.entries()) {
    const std::string where = style + " " + entry.where;
    if (entry.severity == Severity::kWarning) {
      diagnostics->warn(where, entry.message, entry.hint);
    } else {
      diagnostics->note(where, entry.message, entry.hint);
    }
  }
  return stretches;
}

bool has_kind(const std::vector<Stretch>& stretches, PairKind kind) {
  return std::any_of(stretches.begin(), stretches.end(), [&](const Stretch& s) { return s.kind == kind; });
}

void report_missing_kind(const Pairing& pairing, Diagnostics* diagnostics) {
  if (diagnostics == nullptr) return;
  const auto report = [&](PairKind kind, const char* what, const char* lacks) {
    const bool in = has_kind(pairing.inputs, kind);
    const bool out = has_kind(pairing.outputs, kind);
    if (in == out) return;
    diagnostics->warn("pairing",
                      std::string(in ? "input" : "output") + " clips " + what + ", but no " +
                          (in ? "output" : "input") + " clip " + lacks,
                      "give clips of the same action in both styles, or pair whole clips");
  };
  report(PairKind::kGaitCycle, "walk", "does");
  report(PairKind::kWhole, "stay in place", "does");
}

void report_uncovered(const Pairing& pairing, Diagnostics* diagnostics) {
  if (diagnostics == nullptr || pairing.uncovered.empty()) return;
  double least = 1e9;
  double greatest = -1e9;
  for (const Stretch& stretch : pairing.uncovered) {
    least = std::min(least, stretch.features.turning);
    greatest = std::max(greatest, stretch.features.turning);
  }
  diagnostics->warn("pairing",
                    std::to_string(pairing.uncovered.size()) + " of " + std::to_string(pairing.inputs.size()) +
                        " stretches of the input style have nothing like them in the output style (they turn by " +
                        with_decimals(kDegrees * least, 0) + " to " + with_decimals(kDegrees * greatest, 0) +
                        " degrees)",
                    "record the output style doing this too");
}

void check(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs, const PairingOptions& options) {
  if (inputs.empty()) throw InvalidArgument("inputs", "at least one clip", "none");
  if (outputs.empty()) throw InvalidArgument("outputs", "at least one clip", "none");
  if (options.neighbours < 1) throw InvalidArgument("neighbours", "at least 1", std::to_string(options.neighbours));
  if (!(options.turning_scale > 0.0)) {
    throw InvalidArgument("turning_scale", "more than 0 rad", std::to_string(options.turning_scale));
  }
  if (!(options.speed_weight >= 0.0)) {
    throw InvalidArgument("speed_weight", "at least 0", std::to_string(options.speed_weight));
  }
}

}  // namespace

int slope_limit_for(double input_duration, double output_duration) {
  if (!(input_duration > 0.0) || !(output_duration > 0.0)) {
    throw InvalidArgument("duration", "more than 0 s", std::to_string(std::min(input_duration, output_duration)));
  }
  const double ratio = std::max(input_duration / output_duration, output_duration / input_duration);
  if (ratio > kLargestRatio) return 0;
  return ratio > kWideRatio ? 3 : 2;
}

Pairing find_pairs(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs, const PairingOptions& options,
                   Diagnostics* diagnostics) {
  check(inputs, outputs, options);
  Pairing pairing;
  pairing.inputs = stretches_of_style(inputs, "input", options, diagnostics);
  pairing.outputs = stretches_of_style(outputs, "output", options, diagnostics);
  report_missing_kind(pairing, diagnostics);
  for (const PairKind kind : {PairKind::kGaitCycle, PairKind::kWhole}) {
    if (has_kind(pairing.inputs, kind) && has_kind(pairing.outputs, kind)) {
      PairsOfOneKind(pairing, kind, options).make();
    }
  }
  std::stable_sort(pairing.pairs.begin(), pairing.pairs.end(), [](const ClipPair& a, const ClipPair& b) {
    if (a.input_clip != b.input_clip) return a.input_clip < b.input_clip;
    return a.input_frames.begin < b.input_frames.begin;
  });
  report_uncovered(pairing, diagnostics);
  return pairing;
}

}  // namespace strut::learn
