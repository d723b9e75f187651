// SPDX-License-Identifier: MIT
#include "metrics/ground_speed.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <strut/core/error.h>
#include <strut/metrics/gait.h>

namespace strut::metrics {
namespace {

constexpr double kSmoothingSeconds = 1.0 / 6.0;
constexpr double kLead = 0.3;         // of the farthest that a foot is ahead of the other
constexpr double kLeastTravel = 0.5;  // [m]; less is shifting one's weight
constexpr double kSpeedSeconds = 0.15;

/// A row at which a foot comes to lead.
struct Change {
  Eigen::Index row;
  std::size_t side;
};

/// How far the left ankle is ahead of the right, along the heading [m], smoothed. The ends are smoothed as if the feet
/// were level beyond them.
Eigen::VectorXd lead_of_left(const BodyTrack& track) {
  const Eigen::Index frames = track.num_frames();
  const FrameMatrix apart = track.ankles_world[0] - track.ankles_world[1];
  const Eigen::Index half = std::lround(0.5 * (kSmoothingSeconds * track.rate - 1.0));
  Eigen::VectorXd lead = Eigen::VectorXd::Zero(frames + 2 * half);
  lead.segment(half, frames) =
      apart.col(0).array() * track.heading.array().sin() + apart.col(2).array() * track.heading.array().cos();
  return moving_mean(lead, 2 * half + 1);
}

std::vector<Change> changes_of_lead(const BodyTrack& track) {
  const Eigen::VectorXd lead = lead_of_left(track);
  const double level = kLead * lead.cwiseAbs().maxCoeff();
  std::vector<Change> changes;
  int leader = -1;
  for (Eigen::Index row = 0; row < lead.size(); ++row) {
    if (std::abs(lead[row]) <= level) continue;
    const int now = lead[row] > 0.0 ? 0 : 1;
    if (leader >= 0 && now != leader) changes.push_back({row, static_cast<std::size_t>(now)});
    leader = now;
  }
  return changes;
}

void find_longest_step(const BodyTrack& track, const std::vector<Change>& changes, Gait& gait) {
  for (std::size_t i = 1; i < changes.size(); ++i) {
    const double seconds = static_cast<double>(changes[i].row - changes[i - 1].row) / track.rate;
    if (seconds <= gait.longest_step) continue;
    gait.longest_step = seconds;
    gait.longest_step_begin = track.place(track.ankles[changes[i - 1].side], static_cast<double>(changes[i - 1].row));
  }
}

void find_fastest(const BodyTrack& track, Gait& gait) {
  const Eigen::VectorXd speed = ground_speed_curve(track).values;
  const Eigen::Index span = std::clamp<Eigen::Index>(std::lround(kSpeedSeconds * track.rate), 1, speed.size());
  Eigen::Index where = 0;
  gait.top_speed = moving_mean(speed, span).maxCoeff(&where);
  gait.fastest = track.place(-1, static_cast<double>(where) + 0.5 * static_cast<double>(span - 1));
}

void require_two_frames(const BodyTrack& track) {
  if (track.num_frames() >= 2) return;
  throw InvalidArgument("track", "at least two frames", std::to_string(track.num_frames()));
}

}  // namespace

Gait gait(const BodyTrack& track) {
  require_two_frames(track);
  const Eigen::Index frames = track.num_frames();
  Gait gait;
  gait.travel = ground_path(track.hips_world);
  find_fastest(track, gait);
  if (gait.travel <= kLeastTravel) return gait;
  const double seconds = static_cast<double>(frames) / track.rate;
  const Eigen::RowVector3d way = track.hips_world.row(frames - 1) - track.hips_world.row(0);
  gait.speed = std::hypot(way.x(), way.z()) / seconds;
  const auto changes = changes_of_lead(track);
  gait.cadence = static_cast<double>(changes.size()) / seconds;
  find_longest_step(track, changes, gait);
  return gait;
}

Curve ground_speed_curve(const BodyTrack& track) {
  require_two_frames(track);
  return {track.rate, 0.0, ground_speed(track.hips_world, track.rate)};
}

Curve turn_rate_curve(const BodyTrack& track) {
  require_two_frames(track);
  return {track.rate, 0.0, rate_of_change(track.heading, track.rate)};
}

}  // namespace strut::metrics
