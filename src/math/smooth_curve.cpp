// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <strut/core/error.h>
#include <strut/math/smooth_curve.h>

namespace strut::math {
namespace {

constexpr int kBisections = 80;  // halves any interval below the rounding of its ends

/// The slope at a knot between chords of slopes `left` and `right`: their weighted harmonic mean, 0 at a turning point.
double limited_slope(double left, double right, double left_width, double right_width) {
  if (left * right <= 0.0) return 0.0;
  const double w1 = 2.0 * right_width + left_width;
  const double w2 = right_width + 2.0 * left_width;
  return (w1 + w2) / (w1 / left + w2 / right);
}

}  // namespace

SmoothCurve::SmoothCurve(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {
  if (x_.size() < 2) throw InvalidArgument("x", "at least two knots", std::to_string(x_.size()));
  if (x_.size() != y_.size())
    throw InvalidArgument("y", std::to_string(x_.size()) + " values", std::to_string(y_.size()));
  std::vector<double> widths, chords;
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    if (!(x_[i + 1] > x_[i])) throw InvalidArgument("x", "ascending knots", "knot " + std::to_string(i + 1));
    widths.push_back(x_[i + 1] - x_[i]);
    chords.push_back((y_[i + 1] - y_[i]) / widths.back());
  }
  slopes_.push_back(chords.front());
  for (std::size_t i = 1; i < chords.size(); ++i) {
    slopes_.push_back(limited_slope(chords[i - 1], chords[i], widths[i - 1], widths[i]));
  }
  slopes_.push_back(chords.back());
}

std::size_t SmoothCurve::segment(double x) const {
  const auto after = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  return static_cast<std::size_t>(after - x_.begin()) - 1;
}

double SmoothCurve::at(double x) const {
  if (x <= x_.front()) return y_.front() + slopes_.front() * (x - x_.front());
  if (x >= x_.back()) return y_.back() + slopes_.back() * (x - x_.back());
  const std::size_t i = segment(x);
  const double width = x_[i + 1] - x_[i];
  const double u = (x - x_[i]) / width;
  const double rise = u * u * (3.0 - 2.0 * u);
  return y_[i] + (y_[i + 1] - y_[i]) * rise +
         width * (slopes_[i] * u * (1.0 - u) * (1.0 - u) - slopes_[i + 1] * u * u * (1.0 - u));
}

double SmoothCurve::slope(double x) const {
  if (x <= x_.front()) return slopes_.front();
  if (x >= x_.back()) return slopes_.back();
  const std::size_t i = segment(x);
  const double width = x_[i + 1] - x_[i];
  const double u = (x - x_[i]) / width;
  return (y_[i + 1] - y_[i]) / width * 6.0 * u * (1.0 - u) + slopes_[i] * (1.0 - u) * (1.0 - 3.0 * u) -
         slopes_[i + 1] * u * (2.0 - 3.0 * u);
}

double SmoothCurve::inverse(double y) const {
  if (y <= y_.front()) return x_.front() + (y - y_.front()) / slopes_.front();
  if (y >= y_.back()) return x_.back() + (y - y_.back()) / slopes_.back();
  const auto after = std::upper_bound(y_.begin() + 1, y_.end() - 1, y);
  const auto i = static_cast<std::size_t>(after - y_.begin());
  double low = x_[i - 1], high = x_[i];
  for (int k = 0; k < kBisections; ++k) {
    const double middle = (low + high) / 2.0;
    (at(middle) < y ? low : high) = middle;
  }
  return (low + high) / 2.0;
}

}  // namespace strut::math
