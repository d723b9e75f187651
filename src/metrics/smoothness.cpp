// SPDX-License-Identifier: MIT
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

}  // namespace

Smoothness smoothness(const Motion& motion) {
  const double rate = measuring_rate(motion.frame_rate());
  const BodyTrack full = body_track(motion, motion.frame_rate());
  const BodyTrack track = rate == motion.frame_rate() ? full : body_track(motion, rate);
  if (track.num_frames() < kFramesForJerk) {
    throw InvalidArgument(
        "motion", std::to_string(kFramesForJerk) + " frames at " + std::to_string(std::lround(rate)) + " frames/s",
        std::to_string(track.num_frames()));
  }
  // The n-th difference of rows r .. r+n belongs to the time of row r + n/2.
  const FrameMatrix jerks = differences(differences(differences(track.positions_heading))) * (rate * rate * rate);
  const Largest jerk = longest(jerks);
  const FrameMatrix leaps = 0.5 * differences(differences(full.positions_heading));
  const Largest leap = longest(leaps);
  return {jerks.cwiseAbs().mean(), jerk.length, place_of(track, jerk, 1.5), leap.length, place_of(full, leap, 1.0)};
}

}  // namespace strut::metrics
