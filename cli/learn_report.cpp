// SPDX-License-Identifier: MIT
#include "learn_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

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

Json footplants_as_json(const LearnReport& report) {
  if (!report.footplants) return nullptr;
  Json json = {{"left_out_agreement", nullptr}, {"agreement", report.footplants->agreement}};
  if (report.num_left_out > 0) json["left_out_agreement"] = report.footplants->left_out_agreement;
  return json;
}

/// Nothing also in models learnt before footplants were.
std::optional<FootplantReport> footplants_from_json(const Json& report) {
  const Json json = report.value("footplants", Json());
  if (json.is_null()) return std::nullopt;
  const Json& left_out = json.at("left_out_agreement");
  return FootplantReport{left_out.is_null() ? 0.0 : left_out.get<double>(), json.at("agreement").get<double>()};
}

Json block_as_json(const BlockReport& block, bool was_left_out) {
  Json json = {{"name", block.name}, {"states", block.states}, {"left_out_fit", nullptr}, {"fit", block.fit}};
  if (was_left_out) json["left_out_fit"] = block.left_out_fit;
  return json;
}

BlockReport block_from_json(const Json& json) {
  const Json& left_out = json.at("left_out_fit");
  return {json.at("name").get<std::string>(), json.at("states").get<int>(),
          left_out.is_null() ? 0.0 : left_out.get<double>(), json.at("fit").get<double>()};
}

const char* plural(int count) {
  return count == 1 ? "" : "s";
}

/// `3 input and 1 output clips`, or nothing where it is not known.
std::string clips_in_words(const LearnReport& report) {
  if (report.num_input_clips == 0) return "";
  return fmt::format(" of {} input and {} output clip{}", report.num_input_clips, report.num_output_clips,
                     plural(report.num_output_clips));
}

/// Which way and how fast: `12 deg/s to the left`.
std::string turning_in_words(double rate) {
  const double turning = std::round(degrees(rate));
  if (turning == 0.0) return "0 deg/s";
  return fmt::format("{:.0f} deg/s to the {}", std::abs(turning), turning > 0.0 ? "left" : "right");
}

void print_coverage(const LearnReport& report) {
  fmt::print("covers speeds of {:.2f} to {:.2f} m/s\n", report.speed.least, report.speed.greatest);
  fmt::print("       turning from {} to {}\n", turning_in_words(report.turning_rate.least),
             turning_in_words(report.turning_rate.greatest));
  if (report.input_duration.greatest > 0.0) {
    fmt::print("       stretches of {:.2f} to {:.2f} s, which take {:.2f} to {:.2f} s in the style\n",
               report.input_duration.least, report.input_duration.greatest, report.output_duration.least,
               report.output_duration.greatest);
  }
  fmt::print("the style takes {:.2f} times as long as the input\n", report.duration_ratio);
}

void print_fits(const LearnReport& report) {
  const bool has_states = report.num_centres == 0;
  const bool was_left_out = report.num_left_out > 0;
  fmt::print("  {:<24} {}{:>12} {:>12}\n", "part", has_states ? "states " : "", "left out, %", "learnt, %");
  for (const BlockReport& block : report.blocks) {
    fmt::print("  {:<24} {}{:>12} {:>12.1f}\n", block.name, has_states ? fmt::format("{:>6} ", block.states) : "",
               was_left_out ? fmt::format("{:.1f}", block.left_out_fit) : "-", block.fit);
  }
}

void print_footplants(const LearnReport& report) {
  if (!report.footplants) {
    fmt::print("footplants are not told\n");
    return;
  }
  const FootplantReport& found = *report.footplants;
  fmt::print("footplants are told as labelled in {}{:.1f} % of the frames learnt from\n",
             report.num_left_out > 0
                 ? fmt::format("{:.1f} % of the frames of pairs left out, ", 100.0 * found.left_out_agreement)
                 : "",
             100.0 * found.agreement);
}

/// `Spine (12 %), Head (15 %)`; of many parts the first few, and where it is every part of the body, that.
std::string listed(const std::vector<BlockReport>& blocks, std::size_t all, const auto& figure) {
  constexpr std::size_t kMost = 6;
  if (blocks.empty()) return "none";
  std::string text;
  for (std::size_t i = 0; i < std::min(blocks.size(), kMost); ++i) {
    text += (i == 0 ? "" : ", ") + fmt::format("{} ({})", blocks[i].name, figure(blocks[i]));
  }
  if (blocks.size() <= kMost) return text;
  return blocks.size() == all ? "every part, most of all " + text
                              : fmt::format("{} and {} more", text, blocks.size() - kMost);
}

void print_what_is_missing(const LearnReport& report) {
  if (report.num_left_out == 0) {
    fmt::print(
        "no pair could be left out, as each shares a recording with the others: how well new motion is predicted is "
        "not known;\n  another take of both styles would tell\n");
    return;
  }
  fmt::print("predicted poorly, below {:.0f} % on pairs left out: {}\n", learn::kPoorFit,
             listed(learn::poorly_predicted(report), report.blocks.size(),
                    [](const BlockReport& block) { return fmt::format("{:.0f} %", block.left_out_fit); }));
  fmt::print("another take would help, more than {:.0f} points lost on pairs left out: {}\n", learn::kFitLostToNews,
             listed(learn::short_of_takes(report), report.blocks.size(), [](const BlockReport& block) {
               return fmt::format("{:.0f} to {:.0f} %", block.fit, block.left_out_fit);
             }));
}

}  // namespace

Json report_as_json(const LearnReport& report) {
  Json blocks = Json::array();
  for (const BlockReport& block : report.blocks) blocks.push_back(block_as_json(block, report.num_left_out > 0));
  return {{"pairs", report.num_pairs},
          {"pairs_refused", report.num_refused},
          {"pairs_left_out", report.num_left_out},
          {"input_clips", report.num_input_clips},
          {"output_clips", report.num_output_clips},
          {"seconds", report.seconds},
          {"speed", range_as_json(report.speed)},
          {"turning_rate", range_as_json(report.turning_rate)},
          {"input_duration", range_as_json(report.input_duration)},
          {"output_duration", range_as_json(report.output_duration)},
          {"duration_ratio", report.duration_ratio},
          {"centres", report.num_centres},
          {"footplants", footplants_as_json(report)},
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
    // Models learnt before radial maps say nothing of these; every pair of theirs had a figure for being left out.
    report.num_left_out = json.value("pairs_left_out", report.num_pairs);
    report.num_input_clips = json.value("input_clips", 0);
    report.num_output_clips = json.value("output_clips", 0);
    if (json.contains("input_duration")) report.input_duration = range_from_json(json.at("input_duration"));
    if (json.contains("output_duration")) report.output_duration = range_from_json(json.at("output_duration"));
    report.num_centres = json.value("centres", 0);
    report.footplants = footplants_from_json(json);
    for (const Json& block : json.at("blocks")) report.blocks.push_back(block_from_json(block));
    return report;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::string model_in_words(const StyleModel& model) {
  if (const auto& map = model.radial_map()) {
    return fmt::format("a radial map of {} centres, seeing {} components of the whole body at {} moment{}",
                       map->basis.num_centres(), model.context().rows(), map->lags.size(),
                       plural(static_cast<int>(map->lags.size())));
  }
  return fmt::format("linear systems of {} states in {} blocks", model.num_states(), model.blocks().size());
}

void print_report(const LearnReport& report, const StyleModel& model) {
  fmt::print("learnt from {} pair{}{}, {:.1f} s of input ({} refused)\n", report.num_pairs, plural(report.num_pairs),
             clips_in_words(report), report.seconds, report.num_refused);
  print_coverage(report);
  fmt::print("{}; fit of predicted to real output:\n", model_in_words(model));
  print_fits(report);
  print_footplants(report);
  print_what_is_missing(report);
}

}  // namespace strut::cli
