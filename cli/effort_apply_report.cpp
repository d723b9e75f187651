// SPDX-License-Identifier: MIT
#include "effort_apply_report.h"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <strut/io/csv.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;
using effort::AppliedSnippet;
using effort::EffortModel;

/// What is told of a snippet's Effort, in this order.
std::array<std::pair<const char*, effort::EffortVector>, 6> told(const AppliedSnippet& snippet) {
  return {{{"before", snippet.before},
           {"wanted", snippet.wanted},
           {"predicted", snippet.blend.predicted},
           {"deviation", snippet.blend.deviation},
           {"expected", snippet.blend.expected},
           {"estimated", snippet.after}}};
}

std::string number(double value) {
  return effort::is_rated(value) ? fmt::format("{:.2f}", value) : "-";
}

bool is_single(const AppliedSnippet& snippet) {
  return snippet.blend.first == snippet.blend.second;
}

/// "walk_001:0-40 and walk_007:12-50 at 0.35".
std::string blend_in_words(const AppliedSnippet& snippet, const EffortModel& model) {
  const std::string& first = model.fragment(snippet.blend.first).name;
  if (is_single(snippet)) return first;
  return fmt::format("{} and {} at {:.2f}", first, model.fragment(snippet.blend.second).name, snippet.blend.alpha);
}

std::string seconds(const motion::FrameRange& frames, double frame_rate) {
  return fmt::format("{:.2f} to {:.2f}", frames.begin / frame_rate, frames.end / frame_rate);
}

void print_factor(const AppliedSnippet& snippet, effort::Factor factor) {
  fmt::print("  {:>18}", fmt::format("{:>5} {:>5} {:>5}", number(snippet.wanted[factor]),
                                     number(snippet.blend.predicted[factor]), number(snippet.after[factor])));
}

Json number_or_null(double value) {
  return effort::is_rated(value) ? Json(value) : Json(nullptr);
}

Json snippet_as_json(const AppliedSnippet& snippet, double rate, const EffortModel& model) {
  Json json = {{"begin_s", snippet.input.begin / rate},
               {"end_s", snippet.input.end / rate},
               {"output_begin_s", snippet.output.begin / rate},
               {"output_end_s", snippet.output.end / rate}};
  if (snippet.group == effort::kNoMatch) {
    json["group"] = nullptr;
    return json;
  }
  json["group"] = snippet.group;
  json["like"] = model.fragment(snippet.fragment).name;
  json["distance_m"] = snippet.match_cost;
  json["first"] = model.fragment(snippet.blend.first).name;
  json["second"] = model.fragment(snippet.blend.second).name;
  json["alpha"] = snippet.blend.alpha;
  for (const auto& [name, effort] : told(snippet)) {
    for (int factor = 0; factor < effort::kNumPredictedFactors; ++factor) {
      json[name][effort::kFactorNames.at(static_cast<std::size_t>(factor))] = number_or_null(effort[factor]);
    }
  }
  return json;
}

std::string csv_header() {
  std::string header = "begin_s,end_s,output_begin_s,output_end_s,group,like,distance_m,first,second,alpha";
  for (const auto& [name, effort] : told({})) {
    for (int factor = 0; factor < effort::kNumPredictedFactors; ++factor) {
      header += fmt::format(",{}_{}", name, effort::kFactorNames.at(static_cast<std::size_t>(factor)));
    }
  }
  return header + "\n";
}

std::string csv_line(const AppliedSnippet& snippet, double rate, const EffortModel& model) {
  std::string line = fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}", snippet.input.begin / rate, snippet.input.end / rate,
                                 snippet.output.begin / rate, snippet.output.end / rate);
  const bool is_kept = snippet.group == effort::kNoMatch;
  line += is_kept ? ",,,,,,"
                  : fmt::format(",{},{},{:.6g},{},{},{:.6g}", snippet.group,
                                csv_field(model.fragment(snippet.fragment).name), snippet.match_cost,
                                csv_field(model.fragment(snippet.blend.first).name),
                                csv_field(model.fragment(snippet.blend.second).name), snippet.blend.alpha);
  for (const auto& [name, effort] : told(snippet)) {
    for (int factor = 0; factor < effort::kNumPredictedFactors; ++factor) {
      line += is_kept || !effort::is_rated(effort[factor]) ? "," : fmt::format(",{:.6g}", effort[factor]);
    }
  }
  return line + "\n";
}

}  // namespace

void print_applied(const std::string& output, const effort::AppliedEffort& applied, double frame_rate,
                   const EffortModel& model) {
  constexpr double kPercent = 100.0;
  int replaced = 0;
  for (const AppliedSnippet& snippet : applied.snippets) replaced += snippet.group == effort::kNoMatch ? 0 : 1;
  fmt::print("{}: {} frames from {}; {} snippets replaced, {:.0f} % of the motion\n", output,
             applied.motion.num_frames(), applied.snippets.back().input.end, replaced, kPercent * applied.coverage);
  fmt::print("wanted, predicted, and estimated of what was made:\n");
  fmt::print("{:>15}  {:>15}  {:>18}  {:>18}  {:>18}   {}\n", "seconds", "in the output", "flow", "weight", "time",
             "blended from");
  for (const AppliedSnippet& snippet : applied.snippets) {
    fmt::print("{:>15}  {:>15}", seconds(snippet.input, frame_rate), seconds(snippet.output, frame_rate));
    if (snippet.group == effort::kNoMatch) {
      fmt::print("  like nothing known: kept as it is\n");
      continue;
    }
    for (const effort::Factor factor : {effort::kFlow, effort::kWeight, effort::kTime}) print_factor(snippet, factor);
    fmt::print("   {}\n", blend_in_words(snippet, model));
  }
}

std::string format_applied(const std::string& path, const effort::AppliedEffort& applied, double frame_rate,
                           const EffortModel& model) {
  if (path.ends_with(".json")) {
    Json json = {{"coverage", applied.coverage}, {"frame_rate", frame_rate}, {"snippets", Json::array()}};
    for (const AppliedSnippet& snippet : applied.snippets) {
      json["snippets"].push_back(snippet_as_json(snippet, frame_rate, model));
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  std::string text = csv_header();
  for (const AppliedSnippet& snippet : applied.snippets) text += csv_line(snippet, frame_rate, model);
  return text;
}

}  // namespace strut::cli
