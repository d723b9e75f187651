// SPDX-License-Identifier: MIT
// Time is counted from the frames' edges inside (frame 2 covers [2, 3)), so that what a frame covers is a difference of
// two values of the curve; to the outside it is counted at their middles.
#include <cmath>
#include <string>
#include <vector>

#include <strut/align/warp_curve.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kMiddle = 0.5;  // of a frame, from its edge

math::SmoothCurve passed_after(const Eigen::VectorXd& w) {
  if (w.size() == 0) throw InvalidArgument("correspondence", "at least one frame", "none");
  if (!w.allFinite() || (w.array() <= 0.0).any()) {
    throw InvalidArgument("correspondence", "a differential warp of finite numbers above 0", "another");
  }
  std::vector<double> frames{0.0}, passed{0.0};
  for (Eigen::Index t = 0; t < w.size(); ++t) {
    frames.push_back(static_cast<double>(t + 1));
    passed.push_back(passed.back() + w[t]);
  }
  return {std::move(frames), std::move(passed)};
}

/// What lies between the edges of `frames` frames, given where each edge is.
template <typename Edge>
Correspondence between_edges(Eigen::Index frames, const Edge& edge) {
  Correspondence result{Eigen::VectorXd(frames)};
  double before = edge(0.0);
  for (Eigen::Index t = 0; t < frames; ++t) {
    const double after = edge(static_cast<double>(t + 1));
    result.differential_warp[t] = after - before;
    before = after;
  }
  return result;
}

}  // namespace

WarpCurve::WarpCurve(const Correspondence& correspondence) : passed_(passed_after(correspondence.differential_warp)) {}

double WarpCurve::output_frame(double input_frame) const {
  return passed_.at(input_frame + kMiddle) - kMiddle;
}

double WarpCurve::input_frame(double output_frame) const {
  return passed_.inverse(output_frame + kMiddle) - kMiddle;
}

double WarpCurve::slope(double input_frame) const {
  return passed_.slope(input_frame + kMiddle);
}

Correspondence WarpCurve::inverse() const {
  const auto frames = static_cast<Eigen::Index>(std::lround(passed_.y().back()));
  return between_edges(frames, [this](double edge) { return passed_.inverse(edge); });
}

Correspondence compose(const Correspondence& a, const Correspondence& b) {
  const double between = a.differential_warp.sum();
  if (std::lround(between) != b.differential_warp.size()) {
    throw InvalidArgument("b", std::to_string(std::lround(between)) + " input frames, as a has output frames",
                          std::to_string(b.differential_warp.size()));
  }
  const math::SmoothCurve first = passed_after(a.differential_warp), second = passed_after(b.differential_warp);
  return between_edges(a.differential_warp.size(), [&](double edge) { return second.at(first.at(edge)); });
}

}  // namespace strut::align
