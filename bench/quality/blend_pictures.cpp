// SPDX-License-Identifier: MIT
// Draws synthesized cycles as stick figures: a row per style mixture, a column per speed, poses of half a cycle side by
// side, seen from the body's left.
#include "blend_study.h"

#include <cmath>
#include <string>

#include <strut/blend/learn_gaits.h>
#include <strut/core/file.h>
#include <strut/motion/kinematics.h>

namespace strut::study {
namespace {

constexpr double kScale = 62.0;  // points per metre
constexpr int kPoses = 5;        // of half a cycle
constexpr double kCellWidth = 250.0, kCellHeight = 136.0, kLeft = 128.0, kTop = 34.0;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

/// The bones of a pose as one path; `right`: only those of the right limbs, else all others.
std::string bones(const Skeleton& skeleton, const motion::WorldPose& world, double x, double y, bool right) {
  std::string path;
  const auto point = [&](std::size_t j) {
    return number(x + kScale * world.positions[j].z()) + " " + number(y - kScale * world.positions[j].y());
  };
  for (int j = skeleton.pelvis() + 1; j < skeleton.num_joints(); ++j) {
    const Joint& joint = skeleton.joint(j);
    if ((joint.name.rfind("Right", 0) == 0) != right) continue;
    path += "M" + point(static_cast<std::size_t>(joint.parent)) + "L" + point(static_cast<std::size_t>(j));
  }
  return path;
}

std::string cell(const blend::GaitModel& model, const Eigen::VectorXd& weights, double speed, double x, double y) {
  const blend::GaitLoop loop = model.loop(weights, speed);
  std::string svg;
  motion::WorldPose world;
  for (int k = 0; k < kPoses; ++k) {
    const double phase = 0.5 * k / (kPoses - 1);
    motion::forward_kinematics(model.representation().skeleton(), pose_at(model.representation(), loop, phase), world);
    const double at = x + 30.0 + k * (kCellWidth - 60.0) / (kPoses - 1);
    svg += "<path class=\"r\" d=\"" + bones(model.representation().skeleton(), world, at, y, true) + "\"/>";
    svg += "<path class=\"l\" d=\"" + bones(model.representation().skeleton(), world, at, y, false) + "\"/>\n";
  }
  const blend::SpeedRange range = model.speeds(weights);
  const bool beyond = speed < range.slowest || speed > range.fastest;
  return svg + "<path class=\"g\" d=\"M" + number(x + 4) + " " + number(y + 1) + "h" + number(kCellWidth - 8) + "\"/>" +
         (beyond ? "<text class=\"s\" x=\"" + number(x + kCellWidth / 2) + "\" y=\"" + number(y + 13) +
                       "\">beyond the examples</text>"
                 : "");
}

}  // namespace

void draw_cycles(const std::string& path) {
  std::vector<blend::StyledClip> clips;
  std::uint64_t seed = 1;
  for (const auto& [name, style] : walker_styles()) {
    for (const double speed : walker_speeds()) clips.push_back(walk_of(name, style, speed, 1.0, seed++, 60.0));
  }
  const auto model = blend::learn_gaits(blend::gait_examples(clips)).model;
  struct Row {
    const char* name;
    std::vector<std::pair<const char*, double>> weights;
  };
  const std::vector<Row> rows{
      {"crouch", {{"crouch", 1.0}}},   {"half crouch, half march", {{"crouch", 0.5}, {"march", 0.5}}},
      {"march", {{"march", 1.0}}},     {"half march, half swagger", {{"march", 0.5}, {"swagger", 0.5}}},
      {"swagger", {{"swagger", 1.0}}}, {"swagger 1.5, march -0.5", {{"swagger", 1.5}, {"march", -0.5}}}};
  const std::vector<double> speeds{0.6, 1.0, 1.4, 1.8};
  const double width = kLeft + kCellWidth * static_cast<double>(speeds.size());
  const double height = kTop + kCellHeight * static_cast<double>(rows.size()) + 20.0;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " + number(height) +
                    "\" font-family=\"sans-serif\" font-size=\"12\"><style>path{fill:none;stroke-width:2.2;"
                    "stroke-linecap:round;stroke-linejoin:round}.l{stroke:#1f4e8c}.r{stroke:#d9822b}"
                    ".g{stroke:#bbb;stroke-width:1}.s{font-size:9px;fill:#888;text-anchor:middle}</style>"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  for (std::size_t c = 0; c < speeds.size(); ++c) {
    svg += "<text text-anchor=\"middle\" x=\"" + number(kLeft + kCellWidth * (static_cast<double>(c) + 0.5)) +
           "\" y=\"20\">" + number(speeds[c]) + " m/s</text>\n";
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double y = kTop + kCellHeight * (static_cast<double>(r) + 1.0) - 16.0;
    const std::string name = rows[r].name;
    const auto comma = name.find(", ");
    svg += "<text x=\"8\" y=\"" + number(y - 60.0) + "\">" + name.substr(0, comma) + "</text>";
    if (comma != std::string::npos) {
      svg += "<text x=\"8\" y=\"" + number(y - 44.0) + "\">" + name.substr(comma + 2) + "</text>";
    }
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model->styles().size()));
    for (const auto& [style, weight] : rows[r].weights) weights[model->find_style(style)] = weight;
    for (std::size_t c = 0; c < speeds.size(); ++c) {
      svg += cell(*model, weights, speeds[c], kLeft + kCellWidth * static_cast<double>(c), y);
    }
  }
  write_file(path, svg + "</svg>\n", Overwrite::kAllow);
}

}  // namespace strut::study
