// SPDX-License-Identifier: MIT
#include "support/stepper.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <strut/math/rotation.h>

namespace strut::test {
namespace {

enum Index {
  kPelvis,
  kChest,
  kLeftHip,
  kLeftKnee,
  kLeftAnkle,
  kLeftToe,
  kRightHip,
  kRightKnee,
  kRightAnkle,
  kRightToe
};

std::shared_ptr<const Skeleton> body(double s) {
  return std::make_shared<const Skeleton>(std::vector<Joint>{{"pelvis", -1, {0, 0.9 * s, 0}},
                                                             {"chest", kPelvis, {0, 0.4 * s, 0}},
                                                             {"lh", kPelvis, {0.1 * s, 0, 0}},
                                                             {"lk", kLeftHip, {0, -0.4 * s, 0}},
                                                             {"la", kLeftKnee, {0, -0.4 * s, 0}},
                                                             {"lt", kLeftAnkle, {0, -0.08 * s, 0.15 * s}},
                                                             {"rh", kPelvis, {-0.1 * s, 0, 0}},
                                                             {"rk", kRightHip, {0, -0.4 * s, 0}},
                                                             {"ra", kRightKnee, {0, -0.4 * s, 0}},
                                                             {"rt", kRightAnkle, {0, -0.08 * s, 0.15 * s}}});
}

/// Where the body is after so many cycles: on a straight line or an arc.
struct Place {
  Eigen::Vector3d position;
  double heading;
};

Place place(const Steps& steps, double cycles) {
  const double angle = steps.turning * cycles;
  if (std::abs(steps.turning) < 1e-9) return {{0, 0, steps.stride * cycles}, 0.0};
  const double radius = steps.stride / steps.turning;
  return {{radius * (1 - std::cos(angle)), 0, radius * std::sin(angle)}, angle};
}

/// The foot's place: it stands where the body is in the middle of its stance.
Eigen::Vector3d foothold(const Steps& steps, double side, double middle) {
  const Place at = place(steps, middle);
  return at.position + math::rotation_about_y(at.heading) * Eigen::Vector3d(0.1 * side * steps.scale, 0, 0);
}

struct FootState {
  Eigen::Vector3d ankle;
  bool is_planted;
};

FootState foot_state(const Steps& steps, double side, double phase) {
  const double whole = std::floor(phase);
  const double within = phase - whole;
  const double offset = side > 0 ? 0.0 : 0.5;
  const Eigen::Vector3d from = foothold(steps, side, whole + offset + 0.5 * steps.stance);
  const Eigen::Vector3d rest(0, 0.1 * steps.scale, 0);
  if (within < steps.stance) return {from + rest, true};
  const Eigen::Vector3d to = foothold(steps, side, whole + 1 + offset + 0.5 * steps.stance);
  const double swing = (within - steps.stance) / (1 - steps.stance);
  const double lift = (1 - steps.drag) * 0.12 * steps.scale * std::sin(std::numbers::pi * swing);
  const double smooth = 0.5 - 0.5 * std::cos(std::numbers::pi * swing);
  return {from + smooth * (to - from) + rest + Eigen::Vector3d(0, lift, 0), false};
}

double gait_time(const Steps& steps, double time) {
  if (steps.pause_after < 0 || time < steps.pause_after) return time;
  return std::max(steps.pause_after, time - steps.pause);
}

void record(std::vector<motion::Footplant>& plants, int foot, int frame) {
  if (!plants.empty() && plants.back().foot == foot && plants.back().end == frame) {
    plants.back().end = frame + 1;
  } else {
    plants.push_back({foot, frame, frame + 1});
  }
}

}  // namespace

SteppingBody stepping_body(const Steps& steps) {
  const auto skeleton = body(steps.scale);
  const int count = static_cast<int>((steps.cycles * steps.cycle_time + steps.pause) * steps.frame_rate);
  std::vector<Pose> frames(static_cast<std::size_t>(count), rest_pose(*skeleton));
  std::vector<motion::Footplant> plants;
  for (int foot = 0; foot < 2; ++foot) {
    const double side = foot == 0 ? 1.0 : -1.0;
    for (int t = 0; t < count; ++t) {
      // The left foot lands at a quarter cycle, so that no landing falls on the first frame.
      const double cycles = gait_time(steps, t / steps.frame_rate) / steps.cycle_time - 0.25;
      const Place here = place(steps, cycles);
      Pose& pose = frames[static_cast<std::size_t>(t)];
      pose.rotations[0] = math::rotation_about_y(here.heading);
      pose.translations[0] = here.position + Eigen::Vector3d(0, 0.9 * steps.scale, 0);
      const FootState state = foot_state(steps, side, cycles - 0.5 * foot);
      const auto knee = static_cast<std::size_t>(foot == 0 ? kLeftKnee : kRightKnee);
      const Eigen::Vector3d knee_position =
          pose.translations[0] + pose.rotations[0] * (pose.translations[knee - 1] + pose.translations[knee]);
      pose.translations[knee + 1] = pose.rotations[0].conjugate() * (state.ankle - knee_position);
      if (state.is_planted) record(plants, foot, t);
    }
  }
  return {Motion(skeleton, steps.frame_rate, std::move(frames)), plants};
}

}  // namespace strut::test
