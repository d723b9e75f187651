// SPDX-License-Identifier: MIT
// Horizontal speeds read off sampled paths, for the metrics of feet and gait.
#pragma once

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::metrics {

/// Horizontal distance between two rows of a path (T x 3) [m].
double ground_distance(const Eigen::Ref<const FrameMatrix>& path, Eigen::Index from, Eigen::Index to);

/// Horizontal speed at each row of a path [m] (T x 3) sampled at `rate`: central differences, one-sided at the ends.
/// [m/s] (T), T >= 2.
Eigen::VectorXd ground_speed(const Eigen::Ref<const FrameMatrix>& path, double rate);

/// How fast values sampled at `rate` change, by the same differences. [their unit/s] (T), T >= 2.
Eigen::VectorXd rate_of_change(const Eigen::VectorXd& values, double rate);

/// Length of a path's projection on the ground [m].
double ground_path(const Eigen::Ref<const FrameMatrix>& path);

/// Mean of every `span` consecutive values. (T - span + 1), 1 <= span <= T
Eigen::VectorXd moving_mean(const Eigen::VectorXd& values, Eigen::Index span);

}  // namespace strut::metrics
