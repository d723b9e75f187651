// SPDX-License-Identifier: MIT
#include "view/curve_answer.h"

#include "view/page_server.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include <strut/metrics/foot_slide.h>
#include <strut/metrics/gait.h>
#include <strut/metrics/smoothness.h>
#include <strut/motion/joint_curves.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::cli {
namespace {

using Json = Container::Json;
using metrics::BodyTrack;
using metrics::Curve;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kTrackRows = 4;  // what jerk takes
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr std::array<const char*, 2> kFeet = {"left", "right"};

/// A curve that can be asked for.
struct Choice {
  std::string name, joint, label, unit;
  std::function<Eigen::VectorXd(const Motion&)> values;  ///< a number per frame
};
using Choices = std::vector<Choice>;

BodyTrack track_of(const Motion& motion) {
  return metrics::body_track(motion, metrics::measuring_rate(motion.frame_rate()));
}

bool has_track(const Motion& motion) {
  const double seconds = (motion.num_frames() - 1) * motion.frame_time();
  return seconds * metrics::measuring_rate(motion.frame_rate()) >= kTrackRows - 1 &&
         motion::find_legs(motion).has_value();
}

Eigen::VectorXd at_frames(const Curve& curve, const Motion& motion) {
  return metrics::at_frames(curve, motion.num_frames(), motion.frame_rate());
}

/// What `measure` finds on the motion's track, at its frames.
template <typename Measure>
auto on_track(Measure measure, double scale = 1.0) {
  return [measure, scale](const Motion& motion) -> Eigen::VectorXd {
    return scale * at_frames(measure(track_of(motion)), motion);
  };
}

std::vector<motion::Footplant> plants_of(const Motion& motion) {
  const auto legs = motion::find_legs(motion);
  return legs ? postprocess::detect_footplants(motion, *legs) : std::vector<motion::Footplant>{};
}

void add_feet(Choices& choices) {
  for (const int foot : {0, 1}) {
    const char* side = kFeet.at(static_cast<std::size_t>(foot));
    choices.push_back({fmt::format("body/foot-height/{}", side), "", fmt::format("height of the {} foot", side), "m",
                       on_track([foot](const BodyTrack& track) { return metrics::foot_height_curve(track, foot); })});
    choices.push_back({fmt::format("body/slide/{}", side), "", fmt::format("slide of the {} foot while planted", side),
                       "m/s", [foot](const Motion& motion) {
                         return at_frames(metrics::foot_slide_curve(track_of(motion), plants_of(motion), foot), motion);
                       }});
  }
}

void add_body(Choices& choices) {
  const auto heading = [](const BodyTrack& track) { return Curve{track.rate, 0.0, track.heading}; };
  const auto jerk = [](const BodyTrack& track) { return metrics::jerk_curve(track); };
  choices.push_back({"body/speed", "", "speed over the ground", "m/s", on_track(metrics::ground_speed_curve)});
  choices.push_back({"body/heading", "", "heading", "°", on_track(heading, kDegrees)});
  choices.push_back({"body/turn-rate", "", "turning", "°/s", on_track(metrics::turn_rate_curve, kDegrees)});
  choices.push_back({"body/jerk", "", "jerk (mean of joints and axes)", "m/s³", on_track(jerk)});
  add_feet(choices);
}

/// x, y and z of what `curve` gives of the joint.
template <typename OfJoint>
void add_axes(Choices& choices, int joint, const std::string& name, const char* what, const char* unit, OfJoint curve) {
  for (const int axis : {0, 1, 2}) {
    const char* letter = kAxes.at(static_cast<std::size_t>(axis));
    choices.push_back(
        {fmt::format("{}/{}/{}", joint, what, letter), name, fmt::format("{} {}", what, letter), unit,
         [joint, axis, curve](const Motion& motion) -> Eigen::VectorXd { return curve(motion, joint).col(axis); }});
  }
}

void add_joint(Choices& choices, const Motion& motion, int joint) {
  const std::string& name = motion.skeleton().joint(joint).name;
  const auto degrees = [](const Motion& of, int at) -> FrameMatrix {
    return kDegrees * motion::rotation_curve(of, at);
  };
  add_axes(choices, joint, name, "rotation", "°", degrees);
  add_axes(choices, joint, name, "position", "m", motion::position_curve);
  if (motion::moves_in_parent(motion, joint)) {
    add_axes(choices, joint, name, "translation", "m", motion::translation_curve);
  }
}

void add_speed_and_jerk(Choices& choices, const Motion& motion, int joint) {
  const std::string& name = motion.skeleton().joint(joint).name;
  const auto speed = [joint](const BodyTrack& track) { return metrics::joint_speed_curve(track, joint); };
  const auto jerk = [joint](const BodyTrack& track) { return metrics::jerk_curve(track, joint); };
  choices.push_back({fmt::format("{}/speed", joint), name, "speed (from the hips)", "m/s", on_track(speed)});
  choices.push_back(
      {fmt::format("{}/jerk", joint), name, "jerk (from the hips, mean of axes)", "m/s³", on_track(jerk)});
}

Choices choices_of(const Motion& motion) {
  Choices choices;
  const bool tracked = has_track(motion);
  const std::vector<int> moved = tracked ? track_of(motion).joints : std::vector<int>{};
  if (tracked) add_body(choices);
  for (int joint = 0; joint < motion.skeleton().num_joints(); ++joint) {
    add_joint(choices, motion, joint);
    if (std::binary_search(moved.begin(), moved.end(), joint)) add_speed_and_jerk(choices, motion, joint);
  }
  return choices;
}

}  // namespace

Container::Json curves_of(const Motion& motion) {
  Json curves = Json::array();
  for (const Choice& choice : choices_of(motion)) {
    curves.push_back({{"name", choice.name}, {"joint", choice.joint}, {"label", choice.label}, {"unit", choice.unit}});
  }
  return curves;
}

std::vector<float> curve_values(const Motion& motion, const std::string& name) {
  const Choices choices = choices_of(motion);
  const auto found =
      std::find_if(choices.begin(), choices.end(), [&](const Choice& choice) { return choice.name == name; });
  if (found == choices.end()) throw Refusal{404, "the clip has no curve '" + name + "'", {}};
  return as_floats(found->values(motion));
}

Container curve_answer(const Motion& motion, const std::string& name) {
  Container container(Json::object({{"name", name}}));
  container.add("values", curve_values(motion, name));
  return container;
}

std::vector<float> slide_of(const Motion& motion, const std::vector<motion::Footplant>& plants) {
  const auto frames = static_cast<std::size_t>(motion.num_frames());
  std::vector<float> slide(2 * frames, std::numeric_limits<float>::quiet_NaN());
  if (!has_track(motion)) return slide;
  const BodyTrack track = track_of(motion);
  for (const int foot : {0, 1}) {
    const auto values = as_floats(at_frames(metrics::foot_slide_curve(track, plants, foot), motion));
    for (std::size_t i = 0; i < frames; ++i) slide[2 * i + static_cast<std::size_t>(foot)] = values[i];
  }
  return slide;
}

}  // namespace strut::cli
