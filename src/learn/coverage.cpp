// SPDX-License-Identifier: MIT
#include "learn/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <strut/representation/relative_root.h>

namespace strut::learn {
namespace {

constexpr double kTravelSpeed = 0.2;                               // [m/s] below it a pair stands
constexpr double kLeastTurning = 10.0 * std::numbers::pi / 180.0;  // [rad/s] below it a pair goes straight
constexpr double kLittleMotion = 3.0;                              // [s] of pairs
constexpr double kSpeedSpread = 1.15;                              // fastest over slowest below it: one speed
constexpr double kPoorFit = 20.0;                                  // [%] of left-out pairs

std::string rounded(double value, double digits) {
  std::string text = std::to_string(std::round(value * digits) / digits);
  return text.substr(0, text.find('.') + (digits > 1.0 ? 3 : 0));
}

void widen(Range& range, double value, bool first) {
  range.least = first ? value : std::min(range.least, value);
  range.greatest = first ? value : std::max(range.greatest, value);
}

void measure_ranges(const std::vector<FrameMatrix>& signals, const std::vector<ClipPair>& pairs, LearnReport& report) {
  using namespace representation;
  bool first = true;
  for (const ClipPair& pair : pairs) {
    const auto rows = signals[static_cast<std::size_t>(pair.input_clip)].middleRows(
        pair.input_frames.begin, pair.input_frames.end - pair.input_frames.begin);
    const double speed = std::hypot(rows.col(kForwardVelocity).mean(), rows.col(kSidewaysVelocity).mean());
    widen(report.speed, speed, first);
    widen(report.turning_rate, rows.col(kTurningRate).mean(), first);
    first = false;
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
  std::string poor;
  for (const BlockReport& block : report.blocks) {
    if (block.left_out_fit < kPoorFit) poor += (poor.empty() ? "" : ", ") + block.name;
  }
  if (!poor.empty()) {
    diagnostics.warn("learn", "poorly predicted on left-out pairs: " + poor,
                     "more takes of the same action would help");
  }
}

}  // namespace

void report_coverage(const std::vector<FrameMatrix>& signals, const std::vector<ClipPair>& pairs, LearnReport& report,
                     Diagnostics* diagnostics) {
  measure_ranges(signals, pairs, report);
  if (diagnostics == nullptr) return;
  if (report.seconds < kLittleMotion) {
    diagnostics->warn("learn", "only " + rounded(report.seconds, 100) + " s of paired motion",
                      "the style will be rough; add takes");
  }
  warn_of_travel(report, *diagnostics);
  warn_of_joints(report, *diagnostics);
}

}  // namespace strut::learn
