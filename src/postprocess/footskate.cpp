// SPDX-License-Identifier: MIT
// A pipeline over the frames of a window, from its newest frame to the one that is written:
//   newest       where the legs are in the world
//   - decision_  footplants without flicker; one that begins here gets its place, from window_ frames after it; how far
//                the body must be shifted
//   - ramp_      the output: the body's shift is smoothed and feet that do not stand move towards where they will
// Every decision is made once, so a stream and a clip come out the same.
#include "postprocess/footskate_geometry.h"
#include "postprocess/leg_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <strut/core/error.h>
#include <strut/math/low_pass.h>
#include <strut/math/rotation.h>
#include <strut/postprocess/footskate.h>

namespace strut::postprocess {
namespace {

using detail::at;
using detail::horizontal;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int kShortestLookAhead = 3;     // [frames]: one each for flicker, the foot's place and blending
constexpr double kWindowShare = 1.0 / 3;  // of the look-ahead to see where a foot stands; the rest blends
constexpr double kRelease = 0.3;          // time in which a foot that is no longer held comes back to its path [s]
// How long a knee's way of bending is remembered for when it is straight [s], and the sine of how bent it must be to
// know better.
constexpr double kAxisMemory = 0.6;
constexpr double kStraightSine = 0.05;
constexpr double kRounding = 1e-6;  // of numbers of frames
constexpr double kNothing = 1e-12;  // corrections below this are rounding [m, rad]

void require(bool holds, const char* argument, const char* expected, double got) {
  if (!holds) throw InvalidArgument(argument, expected, std::to_string(got));
}

void check(const FootskateOptions& options, double frame_rate) {
  require(std::isfinite(frame_rate) && frame_rate > 0.0, "frame_rate", "a positive finite number", frame_rate);
  require(options.look_ahead > 0.0 && options.look_ahead <= 2.0, "look_ahead", "a time up to 2 s", options.look_ahead);
  require(options.shortest_plant >= 0.0 && options.shortest_plant <= 0.5, "shortest_plant", "0 to 0.5 s",
          options.shortest_plant);
  require(options.shortest_gap >= 0.0 && options.shortest_gap <= 0.5, "shortest_gap", "0 to 0.5 s",
          options.shortest_gap);
  require(options.max_stretch >= 0.0 && options.max_stretch <= 0.1, "max_stretch", "0 to 0.1", options.max_stretch);
  require(options.reach >= 0.5 && options.reach <= 1.0, "reach", "0.5 to 1", options.reach);
  require(options.body_follows >= 0.0 && options.body_follows <= 10.0, "body_follows", "0 to 10 s",
          options.body_follows);
  require(options.max_drag > 0.0 && options.max_drag <= 1.0, "max_drag", "above 0, to 1", options.max_drag);
}

void check(const Skeleton& skeleton, const motion::Leg& leg, const char* argument) {
  const auto is_child = [&](int joint, int parent) {
    return joint > 0 && joint < skeleton.num_joints() && skeleton.joint(joint).parent == parent;
  };
  const bool is_leg = leg.hip > 0 && leg.hip < skeleton.num_joints() && is_child(leg.knee, leg.hip) &&
                      is_child(leg.ankle, leg.knee) && (leg.toe < 0 || is_child(leg.toe, leg.ankle)) &&
                      leg.tip.allFinite();
  if (!is_leg)
    throw InvalidArgument(argument, "hip, knee, ankle and toe of the skeleton, each below the last", "others");
}

/// The joints from below `above` (the root included if it is -1) down to `joint`'s parent, in this order.
std::vector<int> chain_between(const Skeleton& skeleton, int above, int joint, const char* argument) {
  std::vector<int> chain;
  int j = skeleton.joint(joint).parent;
  for (; j != above && j >= 0; j = skeleton.joint(j).parent) chain.insert(chain.begin(), j);
  if (j != above) throw InvalidArgument(argument, "a leg below the skeleton's pelvis", "one that hangs elsewhere");
  return chain;
}

/// Weights of a smooth bump over 2 * half + 1 frames, of sum 1.
std::vector<double> bump(int half) {
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = -half; k <= half; ++k) {
    weights.push_back(0.5 + 0.5 * std::cos(std::numbers::pi * k / (half + 1)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// One frame along the cubic from (value, slope) to (goal, goal_slope) in `frames` frames, slopes per frame.
void step_towards(const Vector3d& goal, const Vector3d& goal_slope, int frames, Vector3d& value, Vector3d& slope) {
  const double n = frames, s = 1.0 / n, s2 = s * s, s3 = s2 * s;
  const Vector3d way = goal - value;
  const Vector3d next = value + (3 * s2 - 2 * s3) * way + n * ((s3 - 2 * s2 + s) * slope + (s3 - s2) * goal_slope);
  slope = (6 * s - 6 * s2) * s * way + (3 * s2 - 4 * s + 1) * slope + (3 * s2 - 2 * s) * goal_slope;
  value = next;
}

}  // namespace

FootskateCleaner::FootskateCleaner(std::shared_ptr<const Skeleton> skeleton, const motion::Legs& legs,
                                   double frame_rate, const FootskateOptions& options)
    : legs_(legs), options_(options), frame_rate_(frame_rate) {
  if (!skeleton) throw InvalidArgument("skeleton", "a skeleton", "null");
  check(options, frame_rate);
  pelvis_ = skeleton->pelvis();
  for (const int foot : {0, 1}) {
    const char* const argument = foot == 0 ? "legs.left" : "legs.right";
    check(*skeleton, legs.foot(foot), argument);
    to_hip_[at(foot)] = chain_between(*skeleton, pelvis_, legs.foot(foot).hip, argument);
  }
  if (pelvis_ > 0) to_pelvis_ = chain_between(*skeleton, -1, pelvis_, "skeleton");

  latency_ = static_cast<int>(std::lround(options.look_ahead * frame_rate));
  require(latency_ >= kShortestLookAhead, "look_ahead", "three frames or more", options.look_ahead);
  // With a short look-ahead flicker gets at most a third of it.
  const auto frames_in = [&](double seconds) {
    return std::clamp(static_cast<int>(std::ceil(seconds * frame_rate - kRounding)), 2, latency_ / 3 + 1);
  };
  shortest_plant_ = frames_in(options.shortest_plant);
  shortest_gap_ = frames_in(options.shortest_gap);
  window_ = std::max(1, static_cast<int>(kWindowShare * latency_));
  // A gap is known to be one when no footplant of some length begins in it.
  decision_ = std::min(std::max(shortest_gap_ + shortest_plant_ - 2, window_ + 1), latency_ - 1);
  window_ = std::min(window_, decision_ - 1);
  ramp_ = latency_ - decision_;
  release_ = std::max(ramp_, static_cast<int>(std::lround(kRelease * frame_rate)));
  least_reach_ = ramp_ / 2;
  kernel_ = bump(ramp_ - least_reach_);
  axis_gain_ = math::low_pass_gain(frame_rate * kAxisMemory);
  follow_gain_ = math::low_pass_gain(frame_rate * options.body_follows);

  frames_.resize(at(latency_ + 1));
  const Pose pose = rest_pose(*skeleton);
  for (Frame& frame : frames_) frame.pose = pose;
  shift_.resize(at(2 * ramp_ + 2));
  lowest_.resize(shift_.size());
  reset();
}

void FootskateCleaner::reset() {
  holds_ = {};
  blends_ = {};
  let_go_ = {};
  steady_flags_ = {};
  std::fill(shift_.begin(), shift_.end(), Vector3d::Zero());
  std::fill(lowest_.begin(), lowest_.end(), Vector3d::Zero());
  last_shift_.setZero();
  newest_ = -1;
  next_output_ = 0;
  end_ = -1;
}

bool FootskateCleaner::push(const Pose& pose, std::array<bool, 2> planted, Pose& output) {
  if (end_ >= 0) reset();
  frame(newest_ + 1).pose = pose;
  frame(newest_ + 1).given = planted;
  take();
  return produce(output);
}

bool FootskateCleaner::flush(Pose& output) {
  if (end_ < 0) end_ = newest_ + 1;
  if (next_output_ >= end_) return false;
  // The last pose is taken to last: a foot that stands at the end stands on.
  for (bool is_written = false; !is_written; is_written = produce(output)) {
    frame(newest_ + 1).pose = frame(newest_).pose;
    frame(newest_ + 1).given = frame(newest_).given;
    take();
  }
  return true;
}

void FootskateCleaner::take() {
  ++newest_;
  locate(frame(newest_));
  const int decided = newest_ - decision_;
  if (decided < 0) return;
  settle_flags(decided);
  decide(decided);
}

bool FootskateCleaner::produce(Pose& output) {
  const int index = newest_ - latency_;
  if (index < 0) return false;
  const Frame& source = frame(index);
  const Vector3d shift = shift_at(index);
  output = source.pose;
  if (!shift.isZero(0.0)) output.translations[at(pelvis_)] += source.above_pelvis.conjugate() * shift;
  for (const int foot : {0, 1}) {
    blend(foot, index, shift);
    pose_leg(foot, source, shift, output);
  }
  last_shift_ = shift;
  next_output_ = index + 1;
  return true;
}

void FootskateCleaner::locate(Frame& frame) const {
  Quaterniond rotation = Quaterniond::Identity();
  Vector3d position = Vector3d::Zero();
  const auto down = [&](int joint) {
    position += rotation * frame.pose.translations[at(joint)];
    rotation = rotation * frame.pose.rotations[at(joint)];
  };
  for (const int joint : to_pelvis_) down(joint);
  frame.above_pelvis = rotation;
  down(pelvis_);
  const Quaterniond pelvis_rotation = rotation;
  const Vector3d pelvis_position = position;
  for (const int foot : {0, 1}) {
    const motion::Leg& leg = legs_.foot(foot);
    LegFrame& place = frame.legs[at(foot)];
    rotation = pelvis_rotation;
    position = pelvis_position;
    for (const int joint : to_hip_[at(foot)]) down(joint);
    place.above = rotation;
    down(leg.hip);
    place.hip = position;
    down(leg.knee);
    place.knee = position;
    down(leg.ankle);
    place.ankle = position;
    place.foot = rotation;
    place.toe = position + rotation * (leg.toe >= 0 ? frame.pose.translations[at(leg.toe)] : leg.tip);
  }
}

/// Whether a foot is given as planted in so many frames that they are a footplant.
bool FootskateCleaner::begins_plant(int foot, int index) const {
  for (int f = index; f < index + shortest_plant_; ++f) {
    if (!frame(f).given[at(foot)]) return false;
  }
  return true;
}

/// A change of the flags counts only if what they change to lasts.
void FootskateCleaner::settle_flags(int index) {
  for (const int foot : {0, 1}) {
    bool& planted = steady_flags_[at(foot)];
    if (!planted) {
      planted = begins_plant(foot, index);
    } else if (!frame(index).given[at(foot)]) {
      planted = false;
      for (int f = index + 1; f < index + shortest_gap_ && !planted; ++f) planted = begins_plant(foot, f);
    }
    frame(index).planted[at(foot)] = planted;
  }
}

/// The next frame after `index`, within sight, in which the foot is planted; -1 if there is none.
int FootskateCleaner::next_landing(int foot, int index) const {
  for (int f = index + 1; f <= index + ramp_; ++f) {
    if (frame(f).planted[at(foot)]) return f;
  }
  return -1;
}

/// How the correction of a planted foot goes on after `index`.
FootskateCleaner::Correction FootskateCleaner::change_after(int foot, int index) const {
  const Frame& next = frame(index + 1);
  // The footplant that was decided last is the one that is held now; of later frames nothing is stored yet.
  const bool is_last = index == newest_ - decision_;
  if (!is_last && !next.planted[at(foot)]) return {};
  const Correction& from = frame(index).wanted[at(foot)];
  const Correction to = is_last ? wanted(foot, index + 1) : next.wanted[at(foot)];
  return {to.move - from.move, to.turn - from.turn};
}

void FootskateCleaner::hold(int foot, int index) {
  Blend& blend = blends_[at(foot)];
  const Correction& now = frame(index).wanted[at(foot)];
  blend.velocity = {};
  if (index > 0) blend.velocity = {now.move - blend.correction.move, now.turn - blend.correction.turn};
  blend.correction = now;
  blend.since_planted = 0;
}

/// A foot in the air moves towards its next place; where none is in sight, back to its path, as the body is shifted.
void FootskateCleaner::blend(int foot, int index, const Vector3d& shift) {
  if (frame(index).planted[at(foot)]) return hold(foot, index);
  Blend& blend = blends_[at(foot)];
  ++blend.since_planted;
  int frames = std::max(1, release_ - blend.since_planted + 1);
  Correction goal{horizontal(shift), Vector3d::Zero()};
  Correction velocity{horizontal(shift - last_shift_), Vector3d::Zero()};
  if (const int landing = next_landing(foot, index); landing >= 0) {
    frames = landing - index + 1;
    goal = frame(landing).wanted[at(foot)];
    velocity = change_after(foot, landing);
  }
  if (index == 0) {
    blend.correction = goal;
    blend.since_planted = release_;
    return;
  }
  step_towards(goal.move, velocity.move, frames, blend.correction.move, blend.velocity.move);
  step_towards(goal.turn, velocity.turn, frames, blend.correction.turn, blend.velocity.turn);
}

/// The axis in the world about which a knee bends, unit: its own where it is bent, what it was where it is straight;
/// zero for a knee that has always been straight.
Vector3d FootskateCleaner::knee_axis(Blend& blend, const Quaterniond& thigh_rotation, const Vector3d& thigh,
                                     const Vector3d& shin) const {
  const Vector3d bend = thigh_rotation.conjugate() * thigh.cross(shin) / std::max(thigh.norm() * shin.norm(), kNothing);
  if (blend.bend_axis.isZero(0.0)) blend.bend_axis = bend;
  blend.bend_axis += axis_gain_ * (bend - blend.bend_axis);
  const double remembered = blend.bend_axis.norm();
  if (remembered < kNothing) return Vector3d::Zero();
  const Vector3d usual = blend.bend_axis / remembered;
  const double sine = std::max(0.0, bend.dot(usual));
  const Vector3d across = bend - bend.dot(usual) * usual;
  return thigh_rotation * (usual * (sine + kStraightSine) + across * (sine / (sine + kStraightSine))).normalized();
}

/// Solves a leg for its foot's correction and the body's shift.
void FootskateCleaner::pose_leg(int foot, const Frame& frame, const Vector3d& shift, Pose& output) {
  const motion::Leg& joints = legs_.foot(foot);
  const LegFrame& leg = frame.legs[at(foot)];
  Blend& blend = blends_[at(foot)];
  const Vector3d thigh = leg.knee - leg.hip, shin = leg.ankle - leg.knee;
  const Quaterniond thigh_rotation = leg.above * frame.pose.rotations[at(joints.hip)];

  const Vector3d axis = knee_axis(blend, thigh_rotation, thigh, shin);
  const Correction& correction = blend.correction;
  const double moved = (correction.move - shift).squaredNorm() + correction.turn.squaredNorm();
  if (moved <= kNothing * kNothing || axis.isZero(0.0)) return;

  const Quaterniond foot_turn = math::exp_map(correction.turn);
  const Vector3d ankle = leg.toe + correction.move - foot_turn * (leg.toe - leg.ankle);
  const auto solution = detail::solve_leg(thigh, shin, ankle - leg.hip - shift, axis, options_.max_stretch);
  if (!solution.changed) return;
  const Quaterniond new_thigh = solution.thigh_turn * thigh_rotation;
  const Quaterniond new_shin = solution.shin_turn * thigh_rotation * frame.pose.rotations[at(joints.knee)];
  output.rotations[at(joints.hip)] = (leg.above.conjugate() * new_thigh).normalized();
  output.rotations[at(joints.knee)] = (new_thigh.conjugate() * new_shin).normalized();
  output.rotations[at(joints.ankle)] = (new_shin.conjugate() * (foot_turn * leg.foot)).normalized();
  output.translations[at(joints.knee)] *= solution.stretch;
  output.translations[at(joints.ankle)] *= solution.stretch;
}

Motion clean_footskate(const Motion& motion, const motion::Legs& legs, const std::vector<motion::Footplant>& plants,
                       const FootskateOptions& options, Diagnostics* diagnostics) {
  FootskateCleaner cleaner(motion.shared_skeleton(), legs, motion.frame_rate(), options);
  std::vector<std::array<bool, 2>> planted(at(motion.num_frames()));
  for (const motion::Footplant& plant : plants) {
    if (plant.foot != 0 && plant.foot != 1) {
      throw InvalidArgument("plants", "foot 0 (left) or 1 (right)", std::to_string(plant.foot));
    }
    if (plant.begin < 0 || plant.end < plant.begin || plant.end > motion.num_frames()) {
      throw InvalidArgument("plants", "frames inside the clip",
                            std::to_string(plant.begin) + " to " + std::to_string(plant.end));
    }
    for (int f = plant.begin; f < plant.end; ++f) planted[at(f)][at(plant.foot)] = true;
  }
  std::vector<Pose> cleaned;
  cleaned.reserve(at(motion.num_frames()));
  Pose pose;
  for (int f = 0; f < motion.num_frames(); ++f) {
    if (cleaner.push(motion.frame(f), planted[at(f)], pose)) cleaned.push_back(pose);
  }
  while (cleaner.flush(pose)) cleaned.push_back(pose);
  for (const int foot : {0, 1}) {
    const int frames = cleaner.frames_let_go()[at(foot)];
    if (diagnostics == nullptr || frames == 0) continue;
    diagnostics->warn("footskate",
                      std::string("the ") + (foot == 0 ? "left" : "right") + " foot was let go in " +
                          std::to_string(frames) + " frames in which it is planted but moves too far",
                      "look at the footplants: a foot that moves this far is not standing");
  }
  return {motion.shared_skeleton(), motion.frame_rate(), std::move(cleaned)};
}

}  // namespace strut::postprocess
