// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>

#include <strut/core/error.h>
#include <strut/metrics/curve.h>

namespace strut::metrics {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kFarthest = 0.5 + 1e-9;  // steps from the nearest value; the rest is rounding

double value_at(const Eigen::VectorXd& values, Eigen::Index i) {
  return i >= 0 && i < values.size() ? values[i] : kNone;
}

/// The value `step` steps after the first.
double between(const Eigen::VectorXd& values, double step) {
  const double below = std::floor(step);
  const double share = step - below;
  const double first = value_at(values, static_cast<Eigen::Index>(below));
  const double second = value_at(values, static_cast<Eigen::Index>(below) + 1);
  if (std::isnan(second)) return share <= kFarthest ? first : kNone;
  if (std::isnan(first)) return 1.0 - share <= kFarthest ? second : kNone;
  return first + share * (second - first);
}

void check_rate(const char* name, double rate) {
  if (!(rate > 0.0) || !std::isfinite(rate)) {
    throw InvalidArgument(name, "a positive number of frames per second", std::to_string(rate));
  }
}

}  // namespace

Eigen::VectorXd at_frames(const Curve& curve, int num_frames, double frame_rate) {
  check_rate("curve.rate", curve.rate);
  check_rate("frame_rate", frame_rate);
  if (num_frames < 0) throw InvalidArgument("num_frames", "0 or more", std::to_string(num_frames));
  Eigen::VectorXd values(num_frames);
  for (Eigen::Index i = 0; i < num_frames; ++i) {
    values[i] = between(curve.values, (static_cast<double>(i) / frame_rate - curve.begin) * curve.rate);
  }
  return values;
}

}  // namespace strut::metrics
