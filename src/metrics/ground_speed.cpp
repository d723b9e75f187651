// SPDX-License-Identifier: MIT
#include "metrics/ground_speed.h"

#include <algorithm>
#include <cmath>

namespace strut::metrics {
double ground_distance(const Eigen::Ref<const FrameMatrix>& path, Eigen::Index from, Eigen::Index to) {
  return std::hypot(path(to, 0) - path(from, 0), path(to, 2) - path(from, 2));
}

Eigen::VectorXd ground_speed(const Eigen::Ref<const FrameMatrix>& path, double rate) {
  Eigen::VectorXd speed(path.rows());
  for (Eigen::Index i = 0; i < path.rows(); ++i) {
    const Eigen::Index before = std::max<Eigen::Index>(i - 1, 0);
    const Eigen::Index after = std::min(i + 1, path.rows() - 1);
    speed[i] = ground_distance(path, before, after) * rate / static_cast<double>(after - before);
  }
  return speed;
}

Eigen::VectorXd rate_of_change(const Eigen::VectorXd& values, double rate) {
  Eigen::VectorXd change(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const Eigen::Index before = std::max<Eigen::Index>(i - 1, 0);
    const Eigen::Index after = std::min(i + 1, values.size() - 1);
    change[i] = (values[after] - values[before]) * rate / static_cast<double>(after - before);
  }
  return change;
}

double ground_path(const Eigen::Ref<const FrameMatrix>& path) {
  double length = 0.0;
  for (Eigen::Index i = 1; i < path.rows(); ++i) length += ground_distance(path, i - 1, i);
  return length;
}

Eigen::VectorXd moving_mean(const Eigen::VectorXd& values, Eigen::Index span) {
  Eigen::VectorXd means(values.size() - span + 1);
  for (Eigen::Index i = 0; i < means.size(); ++i) means[i] = values.segment(i, span).mean();
  return means;
}

}  // namespace strut::metrics
