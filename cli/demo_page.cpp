// SPDX-License-Identifier: MIT
#include "demo_page.h"

#include "demo_body.h"
#include "demo_page_template.h"

#include <cmath>
#include <string_view>

#include <nlohmann/json.hpp>

#include <strut/motion/kinematics.h>

namespace strut::cli {
namespace {

using Json = nlohmann::json;

int millimetres(double metres) {
  return static_cast<int>(std::lround(1000.0 * metres));
}

Json json_points(const Motion& motion) {
  Json numbers = Json::array();
  for (const Pose& pose : motion.frames()) {
    for (const Eigen::Vector3d& point : body_points(motion.skeleton(), pose)) {
      for (const double coordinate : point) numbers.push_back(millimetres(coordinate));
    }
  }
  return numbers;
}

/// Each plant as foot, begin, end, and where heel and toes lie on the ground in the middle of it [mm].
Json json_plants(const DemoClip& clip) {
  Json plants = Json::array();
  for (const motion::Footplant& plant : clip.plants) {
    const Footprint print = footprint(clip.motion, plant);
    plants.push_back({plant.foot, plant.begin, plant.end, millimetres(print.heel.x()), millimetres(print.heel.z()),
                      millimetres(print.toes.x()), millimetres(print.toes.z())});
  }
  return plants;
}

Json json_report(const DemoReport& report) {
  const Skeleton& skeleton = report.clips.front().motion.skeleton();
  const BodyDrawing drawing = body_drawing(skeleton);
  Json json{{"lead", report.lead},        {"fps", report.clips.front().motion.frame_rate()},
            {"parents", drawing.parents}, {"sides", drawing.sides},
            {"head", drawing.head},       {"hips", {skeleton.find("LeftUpLeg"), skeleton.find("RightUpLeg")}},
            {"facts", report.facts}};
  for (const DemoClip& clip : report.clips) {
    json["clips"].push_back({{"title", clip.title},
                             {"note", clip.note},
                             {"num_frames", clip.motion.num_frames()},
                             {"points", json_points(clip.motion)},
                             {"plants", json_plants(clip)}});
  }
  for (const DemoFigure& figure : report.figures) {
    json["figures"].push_back({{"name", figure.name}, {"values", figure.values}});
  }
  return json;
}

}  // namespace

std::string demo_page(const DemoReport& report) {
  static constexpr std::string_view kMark = "@DATA@";
  std::string data = json_report(report).dump();
  // A script element ends at the first "</", wherever it stands.
  for (std::size_t at = data.find("</"); at != std::string::npos; at = data.find("</", at)) data.insert(at + 1, "\\");
  std::string page = kDemoPageTemplate;
  return page.replace(page.find(kMark), kMark.size(), data);
}

}  // namespace strut::cli
