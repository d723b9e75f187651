// SPDX-License-Identifier: MIT
#include "clip_figures.h"

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/metrics/body_track.h>

namespace strut::cli {
namespace {

constexpr const char* kSpeed = "cm/s";
constexpr const char* kJerk = "m/s³";

/// Names the place `at` of `motion` as the extreme of a figure.
Extreme extreme(const Motion& motion, const char* what, double value, const char* unit, const metrics::Place& at) {
  return {what, value, unit, joint_name(motion, at.joint), at.frame, at.time};
}

ClipFigure planted_slide(const Motion& motion, const ClipMeasures& measures) {
  const metrics::FootSlide& planted = measures.planted;
  ClipFigure figure{.name = "Slide in footplants", .value = {}, .unit = kSpeed, .better = "less"};
  if (planted.worst.joint < 0) {
    figure.note = "no footplants were found";
    return figure;
  }
  figure.value = kCmPerMetre * planted.speed;
  figure.note = fmt::format("{} footplant{}", measures.num_footplants, measures.num_footplants == 1 ? "" : "s");
  figure.extreme = extreme(motion, "highest", kCmPerMetre * planted.worst_speed, kSpeed, planted.worst);
  return figure;
}

std::vector<ClipFigure> figures_of(const Motion& motion, const ClipMeasures& measures) {
  const auto at = [&](const char* what, double value, const char* unit, const metrics::Place& place) {
    return extreme(motion, what, value, unit, place);
  };
  const metrics::FootSlide& slide = measures.slide;
  const metrics::Smoothness& smooth = measures.smoothness;
  const metrics::Gait& gait = measures.gait;
  std::vector<ClipFigure> figures{
      {"Foot slide",
       kCmPerMetre * slide.speed,
       kSpeed,
       "less",
       {},
       at("highest", kCmPerMetre * slide.worst_speed, kSpeed, slide.worst)},
      planted_slide(motion, measures),
      {"Jerk", smooth.jerk, kJerk, "less", {}, at("highest", smooth.worst_jerk, kJerk, smooth.worst)},
      {"Largest pop",
       kCmPerMetre * smooth.pop,
       "cm",
       "less",
       {},
       at("at", kCmPerMetre * smooth.pop, "cm", smooth.worst_pop)},
      {"Speed", gait.speed, "m/s", {}, {}, at("highest", gait.top_speed, "m/s", gait.fastest)},
      {"Cadence", gait.cadence, "steps/s"}};
  if (gait.longest_step > 0.0) {
    figures.back().extreme = at("longest step", gait.longest_step, "s", gait.longest_step_begin);
  }
  return figures;
}

/// All of them without values.
std::vector<ClipFigure> no_figures(const std::string& reason) {
  std::vector<ClipFigure> figures{{"Foot slide", {}, kSpeed}, {"Slide in footplants", {}, kSpeed},
                                  {"Jerk", {}, kJerk},        {"Largest pop", {}, "cm"},
                                  {"Speed", {}, "m/s"},       {"Cadence", {}, "steps/s"}};
  for (ClipFigure& figure : figures) figure.note = reason;
  return figures;
}

nlohmann::ordered_json as_json(const Extreme& extreme) {
  nlohmann::ordered_json json{{"what", extreme.what},
                              {"value", extreme.value},
                              {"unit", extreme.unit},
                              {"frame", extreme.frame},
                              {"time", extreme.time}};
  if (!extreme.joint.empty()) json["joint"] = extreme.joint;
  return json;
}

}  // namespace

ClipMeasures measure_clip(const Motion& motion, const std::vector<motion::Footplant>& plants) {
  const metrics::BodyTrack track = metrics::body_track(motion, metrics::measuring_rate(motion.frame_rate()));
  return {.slide = metrics::foot_slide(track),
          .planted = metrics::foot_slide(track, plants),
          .num_footplants = static_cast<int>(plants.size()),
          .smoothness = metrics::smoothness(motion),
          .gait = metrics::gait(track)};
}

std::string joint_name(const Motion& motion, int joint) {
  if (joint < 0) return {};
  const std::string& name = motion.skeleton().joint(joint).name;
  return name.empty() ? fmt::format("joint {}", joint) : name;
}

std::vector<ClipFigure> clip_figures(const Motion& motion, const std::vector<motion::Footplant>& plants) {
  try {
    return figures_of(motion, measure_clip(motion, plants));
  } catch (const InvalidArgument& error) {
    return no_figures(std::string(error.what()).substr(error.argument().size() + 2));
  }
}

nlohmann::ordered_json as_json(const std::vector<ClipFigure>& figures) {
  auto all = nlohmann::ordered_json::array();
  for (const ClipFigure& figure : figures) {
    nlohmann::ordered_json json{{"name", figure.name}, {"value", nullptr}, {"unit", figure.unit}};
    if (figure.value) json["value"] = *figure.value;
    if (!figure.better.empty()) json["better"] = figure.better;
    if (!figure.note.empty()) json["note"] = figure.note;
    if (figure.extreme) json["extreme"] = as_json(*figure.extreme);
    all.push_back(std::move(json));
  }
  return all;
}

}  // namespace strut::cli
