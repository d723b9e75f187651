// SPDX-License-Identifier: MIT
#include "learn/coverage.h"

#include "learn/normalized_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <strut/representation/relative_root.h>

namespace strut::learn {
namespace {

constexpr double kTravelSpeed = 0.2;                               // [m/s] below it a pair stands
constexpr double kLeastTurning = 10.0 * std::numbers::pi / 180.0;  // [rad/s] below it a pair goes straight
constexpr double kLittleMotion = 3.0;                              // [s] of pairs
constexpr double kSpeedSpread = 1.15;                              // fastest over slowest below it: one speed

std::string rounded(double value, double digits) {
  std::string text = std::to_string(std::round(value * digits) / digits);
  return text.substr(0, text.find('.') + (digits > 1.0 ? 3 : 0));
}

void widen(Range& range, double value, bool first) {
  range.least = first ? value : std::min(range.least, value);
  range.greatest = first ? value : std::max(range.greatest, value);
}

void measure_ranges(const Examples& examples, const std::vector<AlignedPair>& aligned, LearnReport& report) {
  using namespace representation;
  bool first = true;
  for (const AlignedPair& pair : aligned) {
    const FrameMatrix& clip = examples.input.clips[static_cast<std::size_t>(pair.input_clip)];
    const auto rows = clip.middleRows(pair.input_frames.begin, pair.input_frames.num_frames());
    const double speed = std::hypot(rows.col(kForwardVelocity).mean(), rows.col(kSidewaysVelocity).mean());
    widen(report.speed, speed, first);
    widen(report.turning_rate, rows.col(kTurningRate).mean(), first);
    widen(report.input_duration, static_cast<double>(rows.rows()) / examples.frame_rate, first);
    // The differential time warp adds up to the output's length.
    widen(report.output_duration, pair.output.rightCols<1>().array().exp().sum() / examples.frame_rate, first);
    first = false;
  }
}

/// Frames of input that a pair covers, however many do.
void measure_seconds(const Examples& examples, const std::vector<AlignedPair>& aligned, LearnReport& report) {
  std::set<std::pair<int, int>> frames;
  for (const AlignedPair& pair : aligned) {
    for (int t = pair.input_frames.begin; t < pair.input_frames.end; ++t) frames.emplace(pair.input_clip, t);
  }
  report.seconds = static_cast<double>(frames.size()) / examples.frame_rate;
}

void count_clips(const std::vector<AlignedPair>& aligned, LearnReport& report) {
  std::set<int> inputs, outputs;
  for (const AlignedPair& pair : aligned) {
    inputs.insert(pair.input_clip);
    outputs.insert(pair.output_clip);
  }
  report.num_input_clips = static_cast<int>(inputs.size());
  report.num_output_clips = static_cast<int>(outputs.size());
}

void count_left_out(const std::vector<AlignedPair>& aligned, LearnReport& report) {
  using sysid::Role;
  report.num_left_out = 0;
  for (const std::vector<Role>& roles : leave_out(aligned).rounds) {
    if (std::find(roles.begin(), roles.end(), Role::kLearn) == roles.end()) continue;
    report.num_left_out += static_cast<int>(std::count(roles.begin(), roles.end(), Role::kTest));
  }
}

void warn_of_travel(const LearnReport& report, Diagnostics& diagnostics) {
  if (report.speed.greatest < kTravelSpeed) return;
  if (report.speed.greatest < kSpeedSpread * report.speed.least) {
    diagnostics.warn("learn",
                     "the examples cover one speed only, " + rounded(report.speed.least, 100) + " to " +
                         rounded(report.speed.greatest, 100) + " m/s",
                     "add slower and faster takes if new motion will vary in speed");
  }
  const bool left = report.turning_rate.greatest > kLeastTurning;
  const bool right = report.turning_rate.least < -kLeastTurning;
  if (left && right) return;
  diagnostics.warn("learn",
                   left || right ? std::string("the examples turn to the ") + (left ? "left" : "right") + " only"
                                 : "the examples hardly turn",
                   "add takes that turn if new motion will turn");
}

void warn_of_joints(const LearnReport& report, Diagnostics& diagnostics) {
  for (const std::string& name : report.untranslated) {
    diagnostics.warn("learn", "'" + name + "' moves in the output style but not in the input style: it keeps its mean");
  }
}

/// Says so where no pair could be left out, so that nothing is known of how new motion will be predicted.
void warn_of_recordings(const LearnReport& report, Diagnostics& diagnostics) {
  if (report.num_left_out > 0) return;
  const bool one_input = report.num_input_clips == 1;
  const bool one_output = report.num_output_clips == 1;
  std::string why = "every pair shares a recording with every other";
  if (one_input && one_output) {
    why = "all pairs are from one recording of each style";
  } else if (one_input || one_output) {
    why = std::string("all pairs share one recording of the ") + (one_input ? "input" : "output") + " style";
  }
  diagnostics.warn("learn", why + ": none could be left out, so how well new motion is predicted is not known",
                   "add another take of both styles");
}

}  // namespace

void report_coverage(const Examples& examples, const std::vector<AlignedPair>& aligned, LearnReport& report,
                     Diagnostics* diagnostics) {
  measure_ranges(examples, aligned, report);
  measure_seconds(examples, aligned, report);
  count_clips(aligned, report);
  count_left_out(aligned, report);
  if (diagnostics == nullptr) return;
  if (report.seconds < kLittleMotion) {
    diagnostics->warn("learn", "only " + rounded(report.seconds, 100) + " s of paired motion",
                      "the style will be rough; add takes");
  }
  warn_of_travel(report, *diagnostics);
  warn_of_joints(report, *diagnostics);
  warn_of_recordings(report, *diagnostics);
}

}  // namespace strut::learn
