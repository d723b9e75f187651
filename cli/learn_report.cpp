// SPDX-License-Identifier: MIT
#include "learn_report.h"

#include <numbers>

#include <fmt/core.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

Json range_as_json(const Range& range) {
  return {range.least, range.greatest};
}

Range range_from_json(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>()};
}

}  // namespace

Json report_as_json(const LearnReport& report) {
  Json blocks = Json::array();
  for (const BlockReport& block : report.blocks) {
    blocks.push_back(
        {{"name", block.name}, {"states", block.states}, {"left_out_fit", block.left_out_fit}, {"fit", block.fit}});
  }
  return {{"pairs", report.num_pairs},
          {"pairs_refused", report.num_refused},
          {"seconds", report.seconds},
          {"speed", range_as_json(report.speed)},
          {"turning_rate", range_as_json(report.turning_rate)},
          {"duration_ratio", report.duration_ratio},
          {"blocks", blocks}};
}

std::optional<LearnReport> report_from_json(const Json& json) {
  try {
    LearnReport report;
    report.num_pairs = json.at("pairs").get<int>();
    report.num_refused = json.at("pairs_refused").get<int>();
    report.seconds = json.at("seconds").get<double>();
    report.speed = range_from_json(json.at("speed"));
    report.turning_rate = range_from_json(json.at("turning_rate"));
    report.duration_ratio = json.at("duration_ratio").get<double>();
    for (const Json& block : json.at("blocks")) {
      report.blocks.push_back({block.at("name").get<std::string>(), block.at("states").get<int>(),
                               block.at("left_out_fit").get<double>(), block.at("fit").get<double>()});
    }
    return report;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

void print_report(const LearnReport& report, const StyleModel& model) {
  fmt::print("learnt from {} pair{}, {:.1f} s of input ({} left out)\n", report.num_pairs,
             report.num_pairs == 1 ? "" : "s", report.seconds, report.num_refused);
  fmt::print("covers speeds {:.2f} to {:.2f} m/s, turning {:+.0f} to {:+.0f} deg/s (left is positive)\n",
             report.speed.least, report.speed.greatest, degrees(report.turning_rate.least),
             degrees(report.turning_rate.greatest));
  fmt::print("the style takes {:.2f} times as long as the input\n", report.duration_ratio);
  fmt::print("{} states in {} blocks; fit of simulated to real output:\n", model.num_states(), model.blocks().size());
  fmt::print("  {:<24} {:>6} {:>12} {:>12}\n", "block", "states", "left out, %", "learnt, %");
  for (const BlockReport& block : report.blocks) {
    fmt::print("  {:<24} {:>6} {:>12.1f} {:>12.1f}\n", block.name, block.states, block.left_out_fit, block.fit);
  }
}

}  // namespace strut::cli
