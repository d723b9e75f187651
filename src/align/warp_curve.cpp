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
// Sums of thousands of frames that differ by less are the same [frames].
constexpr double kRounding = 1e-6;

double output_frames(const Correspondence& correspondence) {
  return correspondence.output_end() + correspondence.output_rest;
}

math::SmoothCurve passed_after(const Correspondence& correspondence) {
  const Eigen::VectorXd& w = correspondence.differential_warp;
  if (w.size() == 0) throw InvalidArgument("correspondence", "at least one frame", "none");
  if (!w.allFinite() || (w.array() <= 0.0).any()) {
    throw InvalidArgument("correspondence", "a differential warp of finite numbers above 0", "another");
  }
  std::vector<double> frames{0.0}, passed{correspondence.output_begin};
  for (Eigen::Index t = 0; t < w.size(); ++t) {
    frames.push_back(static_cast<double>(t + 1));
    passed.push_back(passed.back() + w[t]);
  }
  return {std::move(frames), std::move(passed)};
}

/// What lies between the edges of `frames` frames, given where each edge is among `output_frames`.
template <typename Edge>
Correspondence between_edges(Eigen::Index frames, double output_frames, const Edge& edge) {
  double before = edge(0.0);
  Correspondence result{Eigen::VectorXd(frames), before};
  for (Eigen::Index t = 0; t < frames; ++t) {
    const double after = edge(static_cast<double>(t + 1));
    result.differential_warp[t] = after - before;
    before = after;
  }
  const double rest = output_frames - before;
  result.output_rest = rest > kRounding ? rest : 0.0;
  return result;
}

}  // namespace

WarpCurve::WarpCurve(const Correspondence& correspondence) : passed_(passed_after(correspondence)) {}

double WarpCurve::output_frame(double input_frame) const {
  return passed_.at(input_frame + kMiddle) - kMiddle;
}

double WarpCurve::input_frame(double output_frame) const {
  return passed_.inverse(output_frame + kMiddle) - kMiddle;
}

double WarpCurve::slope(double input_frame) const {
  return passed_.slope(input_frame + kMiddle);
}

Correspondence inverse(const Correspondence& correspondence) {
  if (correspondence.output_begin > kRounding || correspondence.output_rest > kRounding) {
    throw InvalidArgument("correspondence", "one that covers the whole output", "one with open ends",
                          "WarpCurve::input_frame tells what belongs to the part it covers");
  }
  const math::SmoothCurve passed = passed_after(correspondence);
  const auto frames = static_cast<Eigen::Index>(std::lround(passed.y().back()));
  return between_edges(frames, passed.x().back(), [&](double edge) { return passed.inverse(edge); });
}

Correspondence compose(const Correspondence& a, const Correspondence& b) {
  const long between = std::lround(output_frames(a));
  if (between != b.differential_warp.size()) {
    throw InvalidArgument("b", std::to_string(between) + " input frames, as a has output frames",
                          std::to_string(b.differential_warp.size()));
  }
  const math::SmoothCurve first = passed_after(a), second = passed_after(b);
  return between_edges(a.differential_warp.size(), output_frames(b),
                       [&](double edge) { return second.at(first.at(edge)); });
}

}  // namespace strut::align
