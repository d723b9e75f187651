// SPDX-License-Identifier: MIT
#include "blend_report.h"

#include "model_info.h"

#include <cmath>
#include <numbers>

#include <fmt/core.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / std::numbers::pi;

Json errors_as_json(const blend::GaitErrors& errors) {
  return {{"bilinear", kDegrees * errors.bilinear},
          {"style_only", kDegrees * errors.style_only},
          {"speed_only", kDegrees * errors.speed_only},
          {"nearest", kDegrees * errors.nearest},
          {"additive", kDegrees * errors.additive}};
}

/// A number of an object that anybody may have written.
double number_in(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name) || !object[name].is_number()) return std::nan("");
  return object[name].get<double>();
}

void print_left_out(const Json& report) {
  const Json empty = Json::object();
  const Json& mean = report.is_object() && report.contains("left_out_mean_deg") ? report["left_out_mean_deg"] : empty;
  if (std::isnan(number_in(mean, "bilinear"))) return;
  fmt::print("Left out and predicted, joint angles: {:.2f} deg off\n", number_in(mean, "bilinear"));
  fmt::print(
      "  by the style alone {:.2f}, by the speed alone {:.2f}, by the nearest speed of the style {:.2f}, by both "
      "added {:.2f} deg\n",
      number_in(mean, "style_only"), number_in(mean, "speed_only"), number_in(mean, "nearest"),
      number_in(mean, "additive"));
}

}  // namespace

Json gait_report_as_json(const blend::GaitReport& report, const std::vector<std::string>& styles) {
  Json cells = Json::array();
  for (const blend::LeftOutCell& cell : report.left_out) {
    cells.push_back({{"style", styles[static_cast<std::size_t>(cell.style)]},
                     {"speed_m_per_s", cell.speed},
                     {"errors_deg", errors_as_json(cell.errors)}});
  }
  Json all = {{"cells", report.num_cells},
              {"cycles", report.num_cycles},
              {"style_dims", report.style_dims},
              {"content_dims", report.content_dims},
              {"speed_functions", report.speed_functions},
              {"relative_speed", report.relative_speed},
              {"ridge", report.ridge},
              {"converged", report.converged}};
  if (!report.left_out.empty()) {
    all["left_out_mean_deg"] = errors_as_json(report.mean);
    all["left_out"] = std::move(cells);
  }
  return all;
}

Json gait_model_as_json(const std::string& path, const blend::GaitModel& model) {
  Json styles = Json::array();
  for (const blend::GaitStyle& style : model.styles()) {
    styles.push_back({{"name", style.name},
                      {"cycles", style.num_cycles},
                      {"slowest_m_per_s", style.slowest},
                      {"fastest_m_per_s", style.fastest}});
  }
  return {{"file", path},
          {"kind", "gait model"},
          {"frame_rate", model.frame_rate()},
          {"num_joints", model.representation().skeleton().num_joints()},
          {"styles", std::move(styles)},
          {"provenance", provenance_as_json(model.provenance())}};
}

void print_gait_model(const std::string& path, const blend::GaitModel& model) {
  const Json provenance = provenance_as_json(model.provenance());
  fmt::print("{}: gait model, {} joints, {:g} frames/s\n", path, model.representation().skeleton().num_joints(),
             model.frame_rate());
  fmt::print("{:<20} {:>8} {:>20}\n", "style", "cycles", "speeds [m/s]");
  for (const blend::GaitStyle& style : model.styles()) {
    fmt::print("{:<20} {:>8} {:>20}\n", style.name, style.num_cycles,
               fmt::format("{:.2f} to {:.2f}", style.slowest, style.fastest));
  }
  if (provenance.is_object() && provenance.contains("report")) print_left_out(provenance["report"]);
}

}  // namespace strut::cli
