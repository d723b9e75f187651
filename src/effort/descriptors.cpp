// SPDX-License-Identifier: MIT
// Joints' positions at one rate, and what their differences tell.
#include "body_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <strut/core/error.h>
#include <strut/effort/descriptors.h>
#include <strut/math/frame_matrix.h>
#include <strut/math/sampling.h>
#include <strut/motion/kinematics.h>

namespace strut::effort {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFewestRows = 4;         // a third difference needs them
constexpr double kHighest = 10.0;      // frequency of SPARC [Hz]
constexpr double kAmplitude = 0.05;    // of the spectrum that still counts, of its value at 0
constexpr double kResolution = 0.025;  // of the spectrum [Hz]
constexpr double kLeast = 1e-4;        // logarithms are taken of at least this
constexpr Index kRest = 6;             // frames in which the hands are taken to come from rest and to it
constexpr Index kChord = 10;           // frames that a chord of the hands' way spans
constexpr double kNothing = 1e-9;      // below this nothing varies

double safe_log(double value) {
  return std::log(std::max(value, kLeast));
}

/// x, y, z of each joint, a row per frame of kDescriptorRate.
FrameMatrix joint_positions(const Motion& motion) {
  const int num_joints = motion.skeleton().num_joints();
  FrameMatrix positions(motion.num_frames(), 3 * num_joints);
  motion::WorldPose world;
  for (int i = 0; i < motion.num_frames(); ++i) {
    motion::forward_kinematics(motion.skeleton(), motion.frame(i), world);
    for (int j = 0; j < num_joints; ++j) {
      positions.block<1, 3>(i, 3 * j) = world.positions[static_cast<std::size_t>(j)].transpose();
    }
  }
  const double step = motion.frame_rate() / kDescriptorRate;
  const auto rows = static_cast<Index>(1 + std::floor((motion.num_frames() - 1) / step + 1e-6));
  if (rows < kFewestRows) {
    throw InvalidArgument("motion", "at least 4 frames at 30 frames/s", std::to_string(motion.duration()) + " s",
                          "a movement this short cannot be described; choose a longer fragment");
  }
  const VectorXd places = VectorXd::LinSpaced(rows, 0.0, static_cast<double>(rows - 1) * step);
  return math::sample_rows(positions, places);
}

/// Differences of so high an order, per second: one row fewer for each.
FrameMatrix derivative(FrameMatrix signal, int order) {
  for (int i = 0; i < order; ++i) {
    const FrameMatrix difference = signal.bottomRows(signal.rows() - 1) - signal.topRows(signal.rows() - 1);
    signal = kDescriptorRate * difference;
  }
  return signal;
}

/// The hands relative to the pelvis.
FrameMatrix hand_ways(const FrameMatrix& positions, const detail::BodyShape& body) {
  FrameMatrix ways(positions.rows(), 3 * static_cast<Index>(body.hands.size()));
  for (std::size_t k = 0; k < body.hands.size(); ++k) {
    ways.middleCols(3 * static_cast<Index>(k), 3) =
        positions.middleCols(3 * body.hands[k], 3) - positions.middleCols(3 * body.pelvis, 3);
  }
  return ways;
}

double mean_acceleration(const FrameMatrix& positions, const detail::BodyShape& body) {
  const FrameMatrix acceleration = derivative(positions, 2);
  double sum = 0.0;
  for (Index j = 0; j < body.mass.size(); ++j) {
    sum += body.mass[j] * acceleration.middleCols(3 * j, 3).rowwise().norm().sum();
  }
  return sum / static_cast<double>(acceleration.rows());
}

/// Of the centre of mass, per length of a leg.
double mean_height(const FrameMatrix& positions, const detail::BodyShape& body) {
  double lowest = positions(0, 3 * body.pelvis + 1), sum = 0.0;
  for (Index j = body.pelvis; j < body.mass.size(); ++j) {
    lowest = std::min(lowest, positions.col(3 * j + 1).minCoeff());
    sum += body.mass[j] * positions.col(3 * j + 1).mean();
  }
  return (sum - lowest) / body.leg_length;
}

double mean_extent(const FrameMatrix& positions, const detail::BodyShape& body) {
  const FrameMatrix trunk =
      0.5 * (positions.middleCols(3 * body.pelvis, 3) + positions.middleCols(3 * body.shoulders, 3));
  double sum = 0.0;
  for (const int hand : body.hands) sum += (positions.middleCols(3 * hand, 3) - trunk).rowwise().norm().mean();
  return sum / (static_cast<double>(body.hands.size()) * body.arm_length);
}

/// log(way / chords), 0 for a straight way.
double curvature(const FrameMatrix& ways, const VectorXd& speed) {
  const Index span = std::min(kChord, ways.rows() - 1);
  double way = 0.0, chords = 0.0;
  for (Index i = 0; i + span < ways.rows(); ++i) {
    way += speed.segment(i, span).sum() / kDescriptorRate;
    chords += (ways.row(i + span) - ways.row(i)).norm();
  }
  return std::log(std::max(way, kLeast) / std::max(chords, kLeast));
}

/// |sum of x_k exp(-i w k)|, by turning on from one k to the next.
double amplitude_at(const Eigen::Ref<const VectorXd>& x, double w) {
  const double c = std::cos(w), s = std::sin(w);
  double re = 0.0, im = 0.0, cos_k = 1.0, sin_k = 0.0;
  for (Index k = 0; k < x.size(); ++k) {
    re += x[k] * cos_k;
    im += x[k] * sin_k;
    const double next = cos_k * c - sin_k * s;
    sin_k = sin_k * c + cos_k * s;
    cos_k = next;
  }
  return std::hypot(re, im);
}

/// A speed with the way from rest and back to it: half waves on both sides. Where a movement was cut while the hands
/// were moving, the cut's edge would be taken for a lack of smoothness, another one for a cut a frame away.
VectorXd from_rest_to_rest(const VectorXd& speed) {
  VectorXd whole(speed.size() + 2 * kRest);
  for (Index i = 0; i < kRest; ++i) {
    const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / kRest);
    whole[i] = share * speed[0];
    whole[whole.size() - 1 - i] = share * speed[speed.size() - 1];
  }
  whole.segment(kRest, speed.size()) = speed;
  return whole;
}

/// The slope of `y` over `x`; 0 where x does not vary.
double regression_slope(const Eigen::Ref<const VectorXd>& x, const Eigen::Ref<const VectorXd>& y) {
  const VectorXd centred = x.array() - x.mean();
  const double variance = centred.squaredNorm();
  return variance > kNothing ? centred.dot(y) / variance : 0.0;
}

}  // namespace

VectorXd describe(const Motion& motion) {
  if (motion.num_frames() < kFewestRows) {
    throw InvalidArgument("motion", "at least 4 frames", std::to_string(motion.num_frames()));
  }
  const detail::BodyShape body = detail::body_shape(motion);
  const FrameMatrix positions = joint_positions(motion);
  const FrameMatrix ways = hand_ways(positions, body);
  const VectorXd speed = derivative(ways, 1).rowwise().norm();
  const Index changes = speed.size() - 1;
  VectorXd result(static_cast<Index>(kNumDescriptors));
  result[kLogAcceleration] = safe_log(mean_acceleration(positions, body));
  result[kHandSmoothness] = spectral_arc_length(from_rest_to_rest(speed), kDescriptorRate);
  result[kHeight] = mean_height(positions, body);
  result[kLogPeakDeceleration] = safe_log(kDescriptorRate * (speed.head(changes) - speed.tail(changes)).maxCoeff());
  result[kLogPeakSpeed] = safe_log(speed.maxCoeff());
  result[kLogMeanSpeed] = safe_log(speed.mean());
  result[kLogDuration] = safe_log(static_cast<double>(positions.rows()) / kDescriptorRate);
  result[kLogJerk] = safe_log(derivative(ways, 3).rowwise().norm().mean());
  result[kExtent] = mean_extent(positions, body);
  result[kCurvature] = curvature(ways, speed);
  return result;
}

double spectral_arc_length(const Eigen::Ref<const VectorXd>& speed, double rate) {
  if (!(rate > 0.0)) throw InvalidArgument("rate", "a positive number", std::to_string(rate));
  const double whole = speed.sum();
  if (!(whole > kNothing)) return 0.0;
  const auto bins = static_cast<Index>(std::min(kHighest, 0.5 * rate) / kResolution) + 1;
  VectorXd spectrum(bins);
  for (Index i = 0; i < bins; ++i) {
    spectrum[i] = amplitude_at(speed, 2.0 * std::numbers::pi * kResolution * static_cast<double>(i) / rate) / whole;
  }
  Index last = bins - 1;
  while (last > 1 && spectrum[last] < kAmplitude) --last;
  double length = 0.0;
  for (Index i = 0; i < last; ++i) length += std::hypot(1.0 / static_cast<double>(last), spectrum[i + 1] - spectrum[i]);
  return -length;
}

DescriptorScale descriptor_scale(const Eigen::Ref<const MatrixXd>& descriptors) {
  if (descriptors.rows() == 0 || descriptors.cols() != kNumDescriptors) {
    throw InvalidArgument("descriptors", "rows of " + std::to_string(static_cast<int>(kNumDescriptors)) + " numbers",
                          std::to_string(descriptors.rows()) + " x " + std::to_string(descriptors.cols()));
  }
  DescriptorScale scale;
  scale.num_fragments = static_cast<int>(descriptors.rows());
  scale.braking_slope = regression_slope(descriptors.col(kLogPeakSpeed), descriptors.col(kLogPeakDeceleration));
  MatrixXd rows = descriptors;
  rows.col(kLogPeakDeceleration) -= scale.braking_slope * rows.col(kLogPeakSpeed);
  scale.mean = rows.colwise().mean().transpose();
  const MatrixXd centred = rows.rowwise() - scale.mean.transpose();
  scale.deviation = (centred.colwise().squaredNorm() / static_cast<double>(rows.rows())).cwiseSqrt().transpose();
  return scale;
}

VectorXd standardized(const DescriptorScale& scale, const Eigen::Ref<const VectorXd>& descriptors) {
  if (descriptors.size() != kNumDescriptors || scale.mean.size() != kNumDescriptors) {
    throw InvalidArgument("descriptors", std::to_string(static_cast<int>(kNumDescriptors)) + " numbers",
                          std::to_string(descriptors.size()));
  }
  VectorXd z = descriptors;
  z[kLogPeakDeceleration] -= scale.braking_slope * z[kLogPeakSpeed];
  z -= scale.mean;
  for (Index k = 0; k < z.size(); ++k) z[k] = scale.deviation[k] > kNothing ? z[k] / scale.deviation[k] : 0.0;
  return z;
}

}  // namespace strut::effort
