// SPDX-License-Identifier: MIT
// The planning half of footskate cleanup: where a foot that comes to stand is held, what brings it there frame by
// frame, and how the body is shifted so that the legs reach.
#include "postprocess/footskate_geometry.h"

#include <algorithm>
#include <cmath>

#include <strut/math/rotation.h>
#include <strut/postprocess/footskate.h>

namespace strut::postprocess {
namespace {

using detail::at;
using detail::horizontal;
using detail::leg_length;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// A frame counts for a foot's place by one over the square of its speed, speeds below this counting alike
// [leg lengths/s].
constexpr double kStillSpeed = 0.1;
// The heel is held while it is no higher above the toe than when it was put down; at this rise, half of that is left
// [foot lengths].
constexpr double kHeelRise = 0.05;
// The toe is held on its ground, but lifts off where it rises by far more than this: the first and last frames of a
// footplant often have it in the air [leg lengths].
constexpr double kLift = 0.012;
constexpr double kMostTurn = 0.4;     // a foot is not turned by more than this, however far the body turns on it [rad]
constexpr double kSlack = 0.004;      // longer than it was a leg may be by this share before the body comes down
constexpr double kMostDrop = 0.08;    // of the body, to let legs reach [leg lengths]
constexpr double kReturn = 0.25;      // of its shift the body gives up with each footplant,
constexpr double kMostReturn = 0.04;  // but no more than this [leg lengths]
constexpr double kNothing = 1e-12;    // corrections below this are rounding [m, rad]

}  // namespace

void FootskateCleaner::decide(int index) {
  Frame& here = frame(index);
  for (const int foot : {0, 1}) {
    Hold& hold = holds_[at(foot)];
    if (here.planted[at(foot)] && index < hold.not_before) {
      let_go(foot, index);
    }
    if (here.planted[at(foot)] && !hold.planted) begin_plant(foot, index);
    hold.planted = here.planted[at(foot)];
    if (!hold.planted) continue;
    here.wanted[at(foot)] = wanted(foot, index);
    const LegFrame& leg = here.legs[at(foot)];
    const Vector3d dragged = here.wanted[at(foot)].move - slot(shift_, index - 1);
    const bool is_too_far = horizontal(dragged).norm() > options_.max_drag * leg_length(leg.hip, leg.knee, leg.ankle);
    if (!is_too_far) continue;
    hold.planted = false;
    hold.not_before = index + ramp_;
    let_go(foot, index);
  }
  follow(index);
}

void FootskateCleaner::let_go(int foot, int index) {
  frame(index).planted[at(foot)] = false;
  const bool is_real = end_ < 0 || index < end_;  // flush repeats the last frame
  if (is_real) ++let_go_[at(foot)];
}

/// How much a frame says about where a foot stands: the more, the slower it is.
double FootskateCleaner::toe_weight(int foot, int index, bool whole_foot) const {
  const LegFrame& before = frame(std::max(0, index - 1)).legs[at(foot)];
  const LegFrame& after = frame(index + 1).legs[at(foot)];
  const double frames = index > 0 ? 2.0 : 1.0;
  double moved = (after.toe - before.toe).squaredNorm();
  if (whole_foot) moved += (after.ankle - before.ankle).squaredNorm();
  const double still = kStillSpeed * leg_length(after.hip, after.knee, after.ankle) * frames / frame_rate_;
  return 1.0 / (moved + still * still + kNothing);
}

void FootskateCleaner::begin_plant(int foot, int index) {
  Hold& hold = holds_[at(foot)];
  Vector3d place = Vector3d::Zero();
  Eigen::Vector4d rotation = Eigen::Vector4d::Zero();
  double place_weights = 0.0, rotation_weights = 0.0, rise = 0.0;
  for (int f = index; f <= index + window_; ++f) {
    if (!frame(f).given[at(foot)]) continue;
    const LegFrame& leg = frame(f).legs[at(foot)];
    const double weight = toe_weight(foot, f, false), whole_weight = toe_weight(foot, f, true);
    place += weight * leg.toe;
    place_weights += weight;
    const double sign = rotation.dot(leg.foot.coeffs()) < 0.0 ? -1.0 : 1.0;
    rotation += sign * whole_weight * leg.foot.coeffs();
    rise += whole_weight * (leg.ankle.y() - leg.toe.y());
    rotation_weights += whole_weight;
  }
  const LegFrame& leg = frame(index).legs[at(foot)];
  // The place moves with the body's shift, of which a part is given up each time so that it does not grow for ever.
  const Vector3d shift = horizontal(slot(shift_, index - 1));
  const double most = kMostReturn * leg_length(leg.hip, leg.knee, leg.ankle);
  const double given_up = std::min(kReturn, most / std::max(shift.norm(), kNothing));
  hold.place = place / place_weights + (index > 0 ? Vector3d((1.0 - given_up) * shift) : Vector3d::Zero());
  hold.rotation = Quaterniond(rotation).normalized();
  hold.rise = rise / rotation_weights;
}

/// What brings a planted foot to where it is held: the toe always, the heel while it is down.
FootskateCleaner::Correction FootskateCleaner::wanted(int foot, int index) const {
  const Hold& hold = holds_[at(foot)];
  const LegFrame& leg = frame(index).legs[at(foot)];
  Correction correction;
  correction.move = hold.place - leg.toe;
  const double lift =
      std::max(0.0, -correction.move.y()) / (kLift * leg_length(leg.hip, leg.knee, leg.ankle) + kNothing);
  correction.move.y() /= 1.0 + lift * lift;
  const double foot_length = (leg.toe - leg.ankle).norm();
  if (foot_length < 1e-6) return correction;
  const double rise = (leg.ankle.y() - leg.toe.y() - hold.rise) / foot_length;
  // What is left of a rise grows with a slope from 0 to about 1, so that the heel lifts off without a jerk.
  const double risen = std::max(0.0, rise) / kHeelRise;
  const Vector3d turn = math::log_map(hold.rotation * leg.foot.conjugate());
  const double share = turn.squaredNorm() / (kMostTurn * kMostTurn);
  correction.turn = turn / ((1.0 + risen * risen) * std::sqrt(std::sqrt(1.0 + share * share)));
  return correction;
}

/// How far the body must come down for a held foot's leg to reach: at most 0.
double FootskateCleaner::drop_to_reach(int foot, int index) const {
  const LegFrame& leg = frame(index).legs[at(foot)];
  const Correction& correction = frame(index).wanted[at(foot)];
  const Quaterniond turn = math::exp_map(correction.turn);
  const Vector3d ankle = leg.toe + correction.move - turn * (leg.toe - leg.ankle);
  const Vector3d way = ankle - leg.hip - horizontal(slot(shift_, index));
  const double length = leg_length(leg.hip, leg.knee, leg.ankle);
  const double as_it_was = std::min((1.0 + kSlack) * (leg.ankle - leg.hip).norm(), length);
  const double longest = std::max(options_.reach * length, as_it_was);
  const double below = std::sqrt(std::max(0.0, longest * longest - horizontal(way).squaredNorm()));
  return std::clamp(below + way.y(), -kMostDrop * length, 0.0);
}

/// The body's shift as the planted feet want it, before smoothing.
void FootskateCleaner::follow(int index) {
  Vector3d shift = index > 0 ? slot(shift_, index - 1) : Vector3d::Zero();
  shift.y() = 0.0;
  const Frame& here = frame(index);
  Vector3d feet = Vector3d::Zero();
  const int standing = int{here.planted[0]} + int{here.planted[1]};
  for (const std::size_t foot : {0, 1}) {
    if (here.planted[foot]) feet += horizontal(here.wanted[foot].move) / standing;
  }
  if (standing > 0) shift += follow_gain_ * (feet - shift);
  slot(shift_, index) = shift;
  double drop = 0.0;
  for (const int foot : {0, 1}) {
    if (here.planted[at(foot)]) drop = std::min(drop, drop_to_reach(foot, index));
  }
  slot(shift_, index).y() = drop;

  const int middle = index - least_reach_;
  if (middle < 0) return;
  Vector3d lowest = slot(shift_, middle);
  for (int f = std::max(0, middle - least_reach_); f <= index; ++f)
    lowest.y() = std::min(lowest.y(), slot(shift_, f).y());
  slot(lowest_, middle) = lowest;
}

Vector3d FootskateCleaner::shift_at(int index) const {
  const int half = static_cast<int>(kernel_.size()) / 2;
  Vector3d shift = Vector3d::Zero();
  for (int k = -half; k <= half; ++k) shift += kernel_[at(k + half)] * slot(lowest_, index + k);
  return shift;
}

}  // namespace strut::postprocess
