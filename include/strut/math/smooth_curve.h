// SPDX-License-Identifier: MIT
// A curve through given points with a continuous slope that never leaves the range of two neighbouring points: constant
// where they are equal, monotone where they are. That makes it fit to carry time, gait phase and distance.
#pragma once

#include <vector>

namespace strut::math {

/// Piecewise cubic Hermite interpolation with limited slopes (Fritsch and Butland 1984). Straight lines are reproduced
/// exactly. Outside the knots the curve goes on along its end slopes.
class SmoothCurve {
 public:
  /// Throws InvalidArgument if there are fewer than two knots, the sizes differ, or `x` does not ascend strictly.
  SmoothCurve(std::vector<double> x, std::vector<double> y);

  [[nodiscard]] double at(double x) const;
  [[nodiscard]] double slope(double x) const;
  /// The x at which a strictly ascending curve has the value `y`. Undefined for other curves.
  [[nodiscard]] double inverse(double y) const;
  [[nodiscard]] const std::vector<double>& x() const noexcept { return x_; }
  [[nodiscard]] const std::vector<double>& y() const noexcept { return y_; }

 private:
  [[nodiscard]] std::size_t segment(double x) const;

  std::vector<double> x_, y_, slopes_;
};

}  // namespace strut::math
