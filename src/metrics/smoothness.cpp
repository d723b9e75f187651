// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/metrics/smoothness.h>

namespace strut::metrics {
namespace {

constexpr Eigen::Index kFramesForJerk = 4;

struct Largest {
  double length = 0.0;
  Eigen::Index row = 0;
  Eigen::Index joint = 0;
};

/// The longest of all three-vectors in `vectors` (rows x 3J).
Largest longest(const FrameMatrix& vectors) {
  Largest largest;
  for (Eigen::Index row = 0; row < vectors.rows(); ++row) {
    for (Eigen::Index joint = 0; 3 * joint < vectors.cols(); ++joint) {
      const double length = vectors.block<1, 3>(row, 3 * joint).norm();
      if (length > largest.length) largest = {length, row, joint};
    }
  }
  return largest;
}

FrameMatrix differences(const FrameMatrix& rows) {
  return rows.bottomRows(rows.rows() - 1) - rows.topRows(rows.rows() - 1);
}

Place place_of(const BodyTrack& track, const Largest& largest, double offset) {
  return track.place(track.joints[static_cast<std::size_t>(largest.joint)], static_cast<double>(largest.row) + offset);
}

void require_rows(const char* argument, const BodyTrack& track, Eigen::Index rows) {
  if (track.num_frames() >= rows) return;
  throw InvalidArgument(argument,
                        std::to_string(rows) + " frames at " + std::to_string(std::lround(track.rate)) + " frames/s",
                        std::to_string(track.num_frames()));
}

/// The third derivative of `places` (rows x 3J) [m/s^3]: the n-th difference of rows r .. r+n belongs to the time of
/// row r + n/2.
FrameMatrix jerks_of(const FrameMatrix& places, double rate) {
  return differences(differences(differences(places))) * (rate * rate * rate);
}

/// Where a joint is, relative to the hips and the heading (rows x 3).
FrameMatrix places_of(const BodyTrack& track, int joint) {
  const auto found = std::lower_bound(track.joints.begin(), track.joints.end(), joint);
  if (found == track.joints.end() || *found != joint) {
    throw InvalidArgument("joint", "the pelvis or a joint below it", std::to_string(joint));
  }
  return track.positions_heading.middleCols(3 * (found - track.joints.begin()), 3);
}

}  // namespace

Smoothness smoothness(const Motion& motion) {
  const double rate = measuring_rate(motion.frame_rate());
  const BodyTrack full = body_track(motion, motion.frame_rate());
  const BodyTrack track = rate == motion.frame_rate() ? full : body_track(motion, rate);
  require_rows("motion", track, kFramesForJerk);
  const FrameMatrix jerks = jerks_of(track.positions_heading, rate);
  const Largest jerk = longest(jerks);
  const FrameMatrix leaps = 0.5 * differences(differences(full.positions_heading));
  const Largest leap = longest(leaps);
  return {jerks.cwiseAbs().mean(), jerk.length, place_of(track, jerk, 1.5), leap.length, place_of(full, leap, 1.0)};
}

Curve jerk_curve(const BodyTrack& track, int joint) {
  require_rows("track", track, kFramesForJerk);
  const FrameMatrix jerks =
      jerks_of(joint == kAllJoints ? track.positions_heading : places_of(track, joint), track.rate);
  return {track.rate, 1.5 / track.rate, jerks.cwiseAbs().rowwise().mean()};
}

Curve joint_speed_curve(const BodyTrack& track, int joint) {
  require_rows("track", track, 2);
  const FrameMatrix steps = differences(places_of(track, joint));
  return {track.rate, 0.5 / track.rate, steps.rowwise().norm() * track.rate};
}

}  // namespace strut::metrics
