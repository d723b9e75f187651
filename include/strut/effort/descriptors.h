// SPDX-License-Identifier: MIT
// How a fragment moves, in a few numbers of its own kinematics: what estimates of Effort are made from. They do not
// change when a clip is moved or turned on the ground, and hardly with its frame rate: all are taken at
// kDescriptorRate.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include <strut/motion/motion.h>

namespace strut::effort {

/// The rate at which fragments are described [frames/s].
inline constexpr double kDescriptorRate = 30.0;

/// The columns of what describe() gives.
enum Descriptor {
  kLogAcceleration,      ///< log of the mean over time of the body's acceleration, limbs by their mass [log m/s^2]
  kHandSmoothness,       ///< SPARC of the hands' speed, from rest and to it: 0 smooth, more negative the less smooth
  kHeight,               ///< mean height of the centre of mass above the lowest joint, per length of a leg
  kLogPeakDeceleration,  ///< log of the hands' sharpest braking [log m/s^2]
  kLogPeakSpeed,         ///< log of the hands' greatest speed [log m/s]
  kLogMeanSpeed,         ///< log of the hands' mean speed [log m/s]
  kLogDuration,          ///< [log s]
  kLogJerk,              ///< log of the hands' mean jerk [log m/s^3]
  kExtent,               ///< mean distance of the hands from the middle of the trunk, per length of an arm
  kCurvature,            ///< log of how much the hands' way is longer than its chords over a third of a second
  kNumDescriptors
};

/// As files and messages call them, in the order of Descriptor.
inline constexpr std::array<const char*, kNumDescriptors> kDescriptorNames = {
    "log_acceleration", "hand_smoothness", "height",       "log_peak_deceleration",
    "log_peak_speed",   "log_mean_speed",  "log_duration", "log_jerk",
    "extent",           "curvature"};

/// Describes one fragment (kNumDescriptors). Hands are the ends of body_parts' arms and move relative to the pelvis;
/// where no arms are found, the ends of all limbs. Masses are those of Winter (2009, table 4.1) by part of the body,
/// shared out among its bones by length. Throws InvalidArgument if the motion has fewer than 4 frames or lasts less
/// than 4 frames of kDescriptorRate. Cost O(frames x joints): about 0.3 ms for two seconds.
Eigen::VectorXd describe(const Motion& motion);

/// The spectral arc length of a speed profile (Balasubramanian, Melendez-Calderon, Roby-Brami, Burdet 2015): minus the
/// length of the normalized amplitude spectrum's curve up to the last frequency, at most 10 Hz, at which it is at least
/// 0.05 of its value at 0. The spectrum is evaluated every 0.025 Hz, as if padded by zeros. 0 where nothing moves.
/// `speed` at `rate` [samples/s].
double spectral_arc_length(const Eigen::Ref<const Eigen::VectorXd>& speed, double rate);

/// What is usual in one group of fragments of like content.
struct DescriptorScale {
  Eigen::VectorXd mean, deviation;  ///< of each descriptor; a deviation of 0 where nothing varies (kNumDescriptors)
  double braking_slope = 0.0;       ///< by which log peak deceleration rises with log peak speed in the group
  int num_fragments = 0;
};

/// From the group's descriptions, (fragments x kNumDescriptors). The mean and deviation of kLogPeakDeceleration are
/// those of what is left of it once the peak speed is regressed out. Throws InvalidArgument if there is no row or its
/// width differs. Cost O(fragments).
DescriptorScale descriptor_scale(const Eigen::Ref<const Eigen::MatrixXd>& descriptors);

/// One fragment's descriptors against what is usual in its group: mean 0 and deviation 1 within it, 0 where nothing
/// varies; kLogPeakDeceleration with the speed regressed out. (kNumDescriptors)
Eigen::VectorXd standardized(const DescriptorScale& scale, const Eigen::Ref<const Eigen::VectorXd>& descriptors);

}  // namespace strut::effort
