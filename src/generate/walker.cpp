// SPDX-License-Identifier: MIT
// The walker's skeleton, and walks sampled at frames with what is known about each.
#include "walk_pose.h"

#include <cmath>
#include <utility>

#include <strut/core/error.h>
#include <strut/generate/walker.h>

namespace strut::generate {
namespace {

using detail::WalkPoser;

constexpr double kUnitHeight = 1.75;  // of the body whose bones are listed below [m]

void check_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InvalidArgument(name, "a number from " + std::to_string(low) + " to " + std::to_string(high),
                        std::to_string(value));
}

void check_schedule(const std::string& name, const Schedule& schedule, double low, double high) {
  for (const ScheduleKey& key : schedule.keys()) check_range(name.c_str(), key.value, low, high);
}

void check(const WalkContent& content, const WalkStyle& style, double frame_rate) {
  check_range("content.duration", content.duration, 0.01, 3600.0);
  check_schedule("content.speed", content.speed, 0.0, 2.5);
  check_schedule("content.turn_rate", content.turn_rate, -2.0, 2.0);
  check_schedule("content.travel_direction", content.travel_direction, -10.0, 10.0);
  check_range("style.cadence_scale", style.cadence_scale, 0.2, 3.0);
  check_range("style.step_length_scale", style.step_length_scale, 0.0, 1.6);
  check_range("style.step_width", style.step_width, 0.0, 0.6);
  check_range("style.crouch", style.crouch, 0.0, 0.35);
  check_range("style.limp", style.limp, 0.0, 1.0);
  check_range("style.variation", style.variation, 0.0, 3.0);
  check_range("style.heel_strike", style.heel_strike, 0.0, 0.8);
  check_range("style.push_off", style.push_off, 0.0, 1.2);
  check_range("style.foot_lift", style.foot_lift, 0.0, 0.5);
  const double others[] = {style.bounce,     style.hip_sway,   style.hip_twist, style.arm_swing, style.arm_spread,
                           style.elbow_bend, style.torso_lean, style.head_tilt, style.toe_out};
  for (const double value : others) check_range("style", value, -10.0, 10.0);
  check_range("frame_rate", frame_rate, 1.0, 10000.0);
}

/// The frames [begin, end) of every plant of both feet in which `is_down(plant, phase)`.
template <typename IsDown>
std::vector<motion::Footplant> marked_frames(const detail::WalkPlan& plan, const std::vector<double>& phases,
                                             IsDown is_down) {
  std::vector<motion::Footplant> marks;
  for (const int foot : {kLeft, kRight}) {
    for (const detail::Plant& plant : plan.plants[static_cast<std::size_t>(foot)]) {
      motion::Footplant mark{foot, 0, 0};
      for (int frame = 0; frame < static_cast<int>(phases.size()); ++frame) {
        if (!is_down(plant, phases[static_cast<std::size_t>(frame)])) continue;
        if (mark.end == 0) mark.begin = frame;
        mark.end = frame + 1;
      }
      if (mark.end > 0) marks.push_back(mark);
    }
  }
  return marks;
}

/// Adds a limb of the left side and its mirror image: `joints` hang on one another, the first on `parent`.
void add_limbs(std::vector<Joint>& skeleton, int parent, const std::vector<Joint>& joints) {
  for (const char* side : {"Left", "Right"}) {
    int above = parent;
    for (Joint joint : joints) {
      joint.name = side + joint.name;
      joint.parent = above;
      if (side[0] == 'R') joint.offset.x() = -joint.offset.x();
      if (side[0] == 'R') joint.end_site.x() = -joint.end_site.x();
      above = static_cast<int>(skeleton.size());
      skeleton.push_back(joint);
    }
  }
}

}  // namespace

std::shared_ptr<const Skeleton> walker_skeleton(double height) {
  check_range("height", height, 0.8, 2.4);
  std::vector<Joint> joints = {{"Hips", -1, {0, 0.975, 0}},
                               {"Spine", 0, {0, 0.10, 0}},
                               {"Chest", 1, {0, 0.16, 0}},
                               {"Neck", 2, {0, 0.25, 0}},
                               {"Head", 3, {0, 0.10, 0.02}, true, {0, 0.19, 0}}};
  add_limbs(joints, 2,
            {{"Shoulder", 0, {0.03, 0.19, 0}},
             {"Arm", 0, {0.15, 0, 0}},
             {"ForeArm", 0, {0.29, 0, 0}},
             {"Hand", 0, {0.26, 0, 0}, true, {0.17, 0, 0}}});
  add_limbs(joints, 0,
            {{"UpLeg", 0, {0.09, -0.03, 0}},
             {"Leg", 0, {0, -0.435, 0}},
             {"Foot", 0, {0, -0.425, 0}},
             {"Toe", 0, {0, -0.06, 0.135}, true, {0, -0.025, 0.07}}});
  for (Joint& joint : joints) {
    joint.offset *= height / kUnitHeight;
    joint.end_site *= height / kUnitHeight;
  }
  return std::make_shared<const Skeleton>(std::move(joints));
}

Walk generate_walk(const WalkContent& content, const WalkStyle& style, double frame_rate) {
  check(content, style, frame_rate);
  const auto skeleton = walker_skeleton(style.body_height);
  const WalkPoser poser(content, style, skeleton);
  const detail::WalkPlan& plan = poser.plan();
  std::vector<Pose> frames;
  std::vector<double> content_time, gait_phase;
  std::vector<PathPoint> path;
  const int num_frames = 1 + static_cast<int>(std::floor(plan.time.at(content.duration) * frame_rate + 1e-9));
  for (int i = 0; i < num_frames; ++i) {
    const double s = plan.time.inverse(i / frame_rate);
    frames.push_back(poser.pose(s));
    content_time.push_back(s);
    gait_phase.push_back(plan.phase.at(s));
    path.push_back({plan.path.at(s), plan.heading.at(s)});
  }
  auto planted = marked_frames(plan, gait_phase, [](const detail::Plant& plant, double phase) {
    return phase >= plant.flat && phase < plant.toe_off;
  });
  auto flat = marked_frames(plan, gait_phase, [](const detail::Plant& plant, double phase) {
    return phase >= plant.flat && phase <= plant.heel_off;
  });
  return {Motion(skeleton, frame_rate, std::move(frames)),
          std::move(content_time),
          std::move(gait_phase),
          std::move(path),
          std::move(planted),
          std::move(flat),
          plan.time};
}

std::vector<double> true_correspondence(const Walk& a, const Walk& b) {
  const double difference = std::abs(a.content_time.back() - b.content_time.back());
  // Both end at the last frame within their content, so the same content ends within a frame of either.
  if (difference > 2.0 * (a.motion.frame_time() + b.motion.frame_time())) {
    throw InvalidArgument("b", "a walk of the same content as a", "contents that differ in duration");
  }
  std::vector<double> frames;
  for (const double s : a.content_time) {
    const double frame = b.timing.at(s) * b.motion.frame_rate();
    frames.push_back(std::min(std::max(frame, 0.0), b.motion.num_frames() - 1.0));
  }
  return frames;
}

}  // namespace strut::generate
