// SPDX-License-Identifier: MIT
// Where a body's joints are over time, in the form the metrics read: positions relative to the hips and turned so that
// the body always faces forward, beside the path of the hips and the feet over the ground. Made once per clip and then
// measured as often as needed.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>

namespace strut::metrics {

/// The rate at which clips are compared with each other [frames/s].
inline constexpr double kComparisonRate = 30.0;

/// Where in a clip something was found.
struct Place {
  int joint = -1;     ///< index in the skeleton, -1 if no single joint is meant
  int frame = 0;      ///< frame of the clip as it was given, from 0
  double time = 0.0;  ///< after the first frame [s]
};

/// A clip as the metrics see it: T frames, J joints.
struct BodyTrack {
  std::shared_ptr<const Skeleton> skeleton;  ///< whose indices `joints` holds
  double rate = 0.0;                         ///< of the rows below [frames/s]
  double source_rate = 0.0;                  ///< of the clip it was made from [frames/s]
  std::vector<int> joints;                   ///< the pelvis and everything below it, ascending (J)
  FrameMatrix positions_heading;             ///< x, y, z of each of `joints` from the point on the ground below the
                                             ///< hips, x to the body's left, z to where it faces [m] (T x 3J)
  FrameMatrix hips_world;                    ///< midpoint of the two hip joints [m] (T x 3)
  Eigen::VectorXd heading;                   ///< from +Z towards +X, continuous over time [rad] (T)
  std::array<int, 2> ankles{};               ///< left, right: indices in the skeleton
  std::array<int, 2> toes{};                ///< the toe joint; the ankle where the foot has only an end site or nothing
  std::array<FrameMatrix, 2> ankles_world;  ///< [m] (T x 3)
  std::array<FrameMatrix, 2> toes_world;    ///< the toe joint, or the end site, or the ankle [m] (T x 3)

  [[nodiscard]] int num_frames() const noexcept { return static_cast<int>(heading.size()); }
  [[nodiscard]] int num_joints() const noexcept { return static_cast<int>(joints.size()); }
  /// The place of row `row` (halves lie between rows), told in the frames of the clip it was made from.
  [[nodiscard]] Place place(int joint, double row) const;
};

/// A rate near kComparisonRate that a clip of `frame_rate` has without interpolation: every first, second, ... frame.
double measuring_rate(double frame_rate);

/// The track of `motion` at `rate` [frames/s]; resampled where the motion has another.
/// The heading is the horizontal direction square to the line through the hip joints.
/// Throws InvalidArgument if the motion is empty, the rate is not positive, or the skeleton has no pair of legs.
/// Cost O(frames x joints).
BodyTrack body_track(const Motion& motion, double rate);

}  // namespace strut::metrics
