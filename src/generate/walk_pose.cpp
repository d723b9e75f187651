// SPDX-License-Identifier: MIT
// The body over a plan of steps. Signs: X is left, Y up, Z forward; a turn about +X carries what points up to the front
// and what points down to the back; side is +1 left, -1 right.
#include "walk_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <strut/core/error.h>
#include <strut/math/rotation.h>

namespace strut::generate::detail {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kMidStance = 0.31;  // after landing [cycles]
constexpr double kExtension = 0.99;  // of the leg's length at most: the knee keeps 16 degrees and never snaps
constexpr double kAhead = 0.04;      // the pelvis before the middle of the feet, so the leading leg need not bend [m]
constexpr double kHeelBehindAnkle = 0.3;  // of the foot's length from ankle to ball
constexpr int kSamplesPerStep = 48;       // where the pelvis' height is fitted to the legs
constexpr double kHurry = 6.0;            // curvature of the swing as the toes leave: the foot hurries after the body
constexpr double kBrake = -6.0;           // and as the heel lands: it arrives moving, not hovering
constexpr double kLookAhead = 0.35;       // how far ahead the head looks into a turn [s]

/// The quintic over u in [0, 1] from (p0, slope v0) to (p1, slope v1) with curvatures `bend0` and `bend1` times
/// the chord at its ends.
template <typename T>
T quintic(double u, const T& p0, const T& v0, const T& p1, const T& v1, double bend0 = 0.0, double bend1 = 0.0) {
  const double u3 = u * u * u, rest = 1.0 - u;
  const double bends = 0.5 * (bend0 * u * u * rest * rest * rest + bend1 * u3 * rest * rest);
  return p0 + v0 * u + (p1 - p0) * (u3 * (10.0 - 15.0 * u + 6.0 * u * u) + bends) -
         v0 * (u3 * (6.0 - 8.0 * u + 3.0 * u * u)) - v1 * (u3 * (4.0 - 7.0 * u + 3.0 * u * u));
}

/// A bump over u in [0, 1], 1 in the middle, flat to second order at its ends.
double bump(double u) {
  const double w = 4.0 * u * (1.0 - u);
  return w * w * w;
}

// The heel comes down as strike (1 - x)^3; the heel goes up as push (0.8 x^2 + 0.2 x^3). Slopes are per x.
constexpr double kStrikeSlope = -3.0;
constexpr double kPushSlope = 2.2;
double strike_shape(double x) {
  return (1.0 - x) * (1.0 - x) * (1.0 - x);
}
double push_shape(double x) {
  return x * x * (0.8 + 0.2 * x);
}

/// The foot's measures: ball = toe joint seen from the ankle.
struct FootShape {
  double ankle_height, ball_height, ball_ahead, heel_behind;
};

FootShape foot_shape(const Skeleton& skeleton) {
  const Vector3d& ball = skeleton.joint(kToe).offset;
  const double ball_height = -skeleton.joint(kToe).end_site.y();
  return {ball_height - ball.y(), ball_height, ball.z(), kHeelBehindAnkle * ball.z()};
}

/// A foot that rolls over its ball or its heel: where the ankle is for a pitch, and how fast it moves with it.
struct Roll {
  Vector3d pivot, arm;  // arm: pivot to ankle while flat, in the foot's frame
  Quaterniond yaw;
  [[nodiscard]] Vector3d ankle(double pitch) const { return pivot + yaw * (about_x(-pitch) * arm); }
  [[nodiscard]] Vector3d slope(double pitch) const {
    const Vector3d turned = about_x(-pitch) * arm;
    return yaw * Vector3d(0.0, turned.z(), -turned.y());
  }
};

Roll roll_over_ball(const Plant& plant, const FootShape& shape) {
  const Quaterniond yaw = about_y(plant.yaw);
  return {plant.ground + yaw * Vector3d(0, shape.ball_height, shape.ball_ahead),
          Vector3d(0, shape.ankle_height - shape.ball_height, -shape.ball_ahead), yaw};
}

Roll roll_over_heel(const Plant& plant, const FootShape& shape) {
  const Quaterniond yaw = about_y(plant.yaw);
  return {plant.ground + yaw * Vector3d(0, 0, -shape.heel_behind), Vector3d(0, shape.ankle_height, shape.heel_behind),
          yaw};
}

FootState planted_foot(const Plant& plant, double phase, const FootShape& shape) {
  FootState state;
  state.yaw = plant.yaw;
  if (phase < plant.flat) {
    state.pitch = plant.strike * strike_shape((phase - plant.land) / (plant.flat - plant.land));
    state.ankle = roll_over_heel(plant, shape).ankle(state.pitch);
  } else if (phase <= plant.heel_off) {
    state.ankle = plant.ground + Vector3d(0, shape.ankle_height, 0);
  } else {
    state.pitch = -plant.push * push_shape((phase - plant.heel_off) / (plant.toe_off - plant.heel_off));
    state.toe_bend = -state.pitch;
    state.ankle = roll_over_ball(plant, shape).ankle(state.pitch);
  }
  return state;
}

FootState swinging_foot(const Plant& from, const Plant& to, double phase, const FootShape& shape, double side) {
  const double swing = to.land - from.toe_off;
  const double u = (phase - from.toe_off) / swing;
  const double rate0 = -from.push * kPushSlope * swing / (from.toe_off - from.heel_off);
  const double rate1 = to.strike > 0.0 ? to.strike * kStrikeSlope * swing / (to.flat - to.land) : 0.0;
  const Roll ball = roll_over_ball(from, shape), heel = roll_over_heel(to, shape);
  FootState state;
  state.pitch = quintic(u, -from.push, rate0, to.strike, rate1);
  state.toe_bend = quintic(u, from.push, -rate0, 0.0, 0.0);
  state.yaw = quintic(u, from.yaw, 0.0, to.yaw, 0.0);
  const Vector3d v0 = rate0 * ball.slope(-from.push), v1 = rate1 * heel.slope(to.strike);
  state.ankle = quintic(u, ball.ankle(-from.push), v0, heel.ankle(to.strike), v1, kHurry, kBrake);
  state.ankle += bump(u) * (Vector3d(0, to.lift, 0) + about_y(state.yaw) * Vector3d(side * to.swing_out, 0, 0));
  return state;
}

void check_reach(double spare, double s) {
  if (spare > 0.0) return;
  throw InvalidArgument("style", "steps the legs can reach",
                        "a step too long or too wide at content time " + std::to_string(s) + " s",
                        "lower step_length_scale, step_width or the speed");
}

}  // namespace

WalkPoser::WalkPoser(const WalkContent& content, const WalkStyle& style, std::shared_ptr<const Skeleton> skeleton)
    : style_(style),
      direction_(content.travel_direction),
      skeleton_(std::move(skeleton)),
      plan_(plan_walk(content, style)),
      base_height_(base_height(content.duration)) {}

FootState WalkPoser::foot(int foot, double phase) const {
  const std::vector<Plant>& plants = plan_.plants[static_cast<std::size_t>(foot)];
  auto next = std::upper_bound(plants.begin(), plants.end(), phase,
                               [](double p, const Plant& plant) { return p < plant.land; });
  if (next == plants.begin()) ++next;  // before the first plan nothing is shown
  const Plant& plant = *(next - 1);
  const FootShape shape = foot_shape(*skeleton_);
  if (phase < plant.toe_off || next == plants.end()) return planted_foot(plant, phase, shape);
  return swinging_foot(plant, *next, phase, shape, foot == kLeft ? 1.0 : -1.0);
}

/// 1 while the bad leg carries alone, 0 half a cycle later; smooth.
double WalkPoser::bad_stance(double phase) const {
  const double centre = kMidStance + (style_.limp_foot == kLeft ? 0.0 : 0.5);
  const double wave = 0.5 + 0.5 * std::cos(kTwoPi * (phase - centre));
  return wave * wave;
}

WalkPoser::Pelvis WalkPoser::pelvis(double s) const {
  const double phase = plan_.phase.at(s), gait = plan_.gait.at(s), reach = plan_.reach.at(s);
  const double pace = gait * (0.5 + 0.5 * reach);
  const double bad = style_.limp * gait * bad_stance(phase);
  const double bad_side = style_.limp_foot == kLeft ? 1.0 : -1.0;
  const double over_left = std::cos(kTwoPi * (phase - kMidStance));
  Pelvis pelvis;
  pelvis.twist = -0.09 * style_.hip_twist * reach * std::abs(std::cos(direction_.at(s))) * std::cos(kTwoPi * phase);
  pelvis.list = 0.06 * style_.hip_sway * pace * std::cos(kTwoPi * (phase - 0.2)) -
                0.07 * bad_side * style_.limp * gait * bad_stance(phase - 0.5);
  const double sway = 0.025 * style_.hip_sway * pace * over_left + 0.03 * bad_side * bad;
  const double heading = plan_.heading.at(s);
  pelvis.position = plan_.path.at(s) + about_y(heading) * Vector3d(sway, 0, 0) +
                    about_y(heading + direction_.at(s)) * Vector3d(0, 0, kAhead * reach);
  pelvis.position.y() =
      -0.024 * style_.bounce * gait * reach * reach * std::cos(2.0 * kTwoPi * (phase - kDoubleSupport / 2.0)) -
      0.03 * bad;
  pelvis.rotation = about_y(heading + pelvis.twist) * about_x(0.3 * style_.torso_lean) * about_z(pelvis.list);
  return pelvis;
}

/// The base height at which, at this moment, the straighter leg is just as long as it may be.
double WalkPoser::reachable_height(double s) const {
  const double longest = kExtension * -(offset(kShank).y() + offset(kFoot).y());
  const Pelvis body = pelvis(s);
  double height = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 2; ++side) {
    const Vector3d hip = body.rotation * offset(kThigh + side * kSideOfLeg);
    const Vector3d ankle = foot(side, plan_.phase.at(s)).ankle;
    const double across = std::hypot(body.position.x() + hip.x() - ankle.x(), body.position.z() + hip.z() - ankle.z());
    check_reach(0.9 * longest - across, s);
    height = std::min(height, ankle.y() + std::sqrt(longest * longest - across * across) - hip.y());
  }
  return height - body.position.y();
}

/// Between two knots of the plan the base may be as high as the worst moment allows; a knot takes the lower neighbour.
math::SmoothCurve WalkPoser::base_height(double duration) const {
  const std::vector<double>& knots = plan_.phase.x();
  const auto first = std::upper_bound(knots.begin(), knots.end(), 0.0) - knots.begin() - 1;
  const auto last = std::lower_bound(knots.begin(), knots.end(), duration) - knots.begin();
  std::vector<double> heights(knots.size(), std::numeric_limits<double>::infinity());
  for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
    double allowed = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kSamplesPerStep; ++k) {
      allowed = std::min(allowed, reachable_height(knots[i] + (knots[i + 1] - knots[i]) * k / kSamplesPerStep));
    }
    heights[i] = std::min(heights[i], allowed - style_.crouch);
    heights[i + 1] = std::min(heights[i + 1], allowed - style_.crouch);
  }
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const bool stands = plan_.phase.y()[i] == plan_.phase.y()[i + 1];
    if (stands) heights[i] = heights[i + 1] = std::min(heights[i], heights[i + 1]);
  }
  std::fill(heights.begin(), heights.begin() + first, heights[static_cast<std::size_t>(first)]);
  std::fill(heights.begin() + last + 1, heights.end(), heights[static_cast<std::size_t>(last)]);
  return {knots, heights};
}

Pose WalkPoser::pose(double s) const {
  Pose pose = rest_pose(*skeleton_);
  Pelvis body = pelvis(s);
  body.position.y() += base_height_.at(s);
  pose.translations[kHips] = body.position;
  pose.rotations[kHips] = body.rotation;
  pose_upper_body(s, body, pose);
  for (int side = 0; side < 2; ++side) {
    pose_arm(s, side, pose);
    pose_leg(s, side, body, pose);
  }
  return pose;
}

void WalkPoser::pose_upper_body(double s, const Pelvis& pelvis, Pose& pose) const {
  const double phase = plan_.phase.at(s), gait = plan_.gait.at(s);
  const double bad = style_.limp * gait * bad_stance(phase);
  const double bad_side = style_.limp_foot == kLeft ? 1.0 : -1.0;
  const double twist = -1.8 * pelvis.twist * plan_.liveliness.at(s);  // the chest turns 0.8 of the pelvis the other way
  const double tilt = -0.9 * pelvis.list - 0.22 * bad_side * bad;
  const double lean = 0.35 * style_.torso_lean + 0.05 * style_.limp * gait;
  const double look = 0.5 * std::clamp(plan_.heading.at(s + kLookAhead) - plan_.heading.at(s), -0.8, 0.8);
  pose.rotations[kSpine] = about_y(twist / 2) * about_x(lean) * about_z(tilt / 2);
  pose.rotations[kChest] = about_y(twist / 2) * about_x(lean) * about_z(tilt / 2);
  const double straighten = -(0.3 * style_.torso_lean + 2.0 * lean) * 0.8 + style_.head_tilt;
  const double untwist = -(pelvis.twist + twist) + look;
  const double upright = -(pelvis.list + tilt) * 0.7;
  pose.rotations[kNeck] = about_y(untwist / 2) * about_x(straighten / 2) * about_z(upright / 2);
  pose.rotations[kHead] = pose.rotations[kNeck];
}

void WalkPoser::pose_arm(double s, int side, Pose& pose) const {
  const double forward = -std::cos(kTwoPi * (plan_.phase.at(s) - 0.5 * side - 0.02));  // against the leg of its side
  const double reach = std::min(plan_.reach.at(s), 1.4) * std::abs(std::cos(direction_.at(s)));
  const double swing = style_.arm_swing * reach * plan_.liveliness.at(s);
  const double flexion = 0.05 + swing * (forward + 0.1);
  const double elbow = style_.elbow_bend + 0.35 * swing * (1.0 + forward);
  place_arm(side, {flexion, style_.arm_spread, 0.0, elbow, 0.1}, pose);
}

void WalkPoser::pose_leg(double s, int side, const Pelvis& pelvis, Pose& pose) const {
  const FootState state = foot(side, plan_.phase.at(s));
  const double heading = plan_.heading.at(s);
  const Vector3d ahead = about_y(heading + 0.5 * (pelvis.twist + state.yaw - heading)) * Vector3d::UnitZ();
  place_leg(*skeleton_, side, pelvis.position, pelvis.rotation, ahead, state, pose);
}

}  // namespace strut::generate::detail
