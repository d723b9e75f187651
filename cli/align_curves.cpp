// SPDX-License-Identifier: MIT
// Figure 2 of Hsu et al. 2005: a degree of freedom of both clips with what belongs together, and the input's curve
// brought into the output's time by two methods. Every panel has the two curves in bands of their own, at one scale, so
// that the ties between them can be seen.
#include "align_figure.h"

#include <algorithm>
#include <cmath>

namespace strut::cli {
namespace {

constexpr double kPanelGap = 20.0, kBandHeight = 84.0, kBandGap = 14.0, kTitleHeight = 18.0, kAxisHeight = 32.0;
constexpr double kPanelWidth = (kFigureWidth - kFigureLeft - kFigureRight - 2.0 * kPanelGap) / 3.0;
constexpr int kMostTies = 50;         // more would be a hatching
constexpr double kLeastRange = 0.02;  // [the quantity's unit] of a curve that does not move
constexpr double kHeadroom = 1.1;     // of a band over the curve in it

/// Frames [begin, end) of a clip of `num_frames`, as far as `span` shows them, and one to either side.
struct Shown {
  Eigen::Index begin = 0, end = 0;
  Shown(const Span& span, double frame_rate, Eigen::Index num_frames)
      : begin(std::max<Eigen::Index>(0, static_cast<Eigen::Index>(std::floor(span.begin * frame_rate)) - 1)),
        end(std::min(num_frames, static_cast<Eigen::Index>(std::ceil(span.end * frame_rate)) + 2)) {}
};

class Curves {
 public:
  Curves(Svg& svg, const AlignFigure& figure, double top)
      : svg_(svg),
        figure_(figure),
        top_(top + kTitleHeight),
        input_shown_(figure.close.input, figure.frame_rate, figure.input_curve.size()),
        output_shown_(figure.close.output, figure.frame_rate, figure.output_curve.size()) {
    const auto input = figure.input_curve.segment(input_shown_.begin, input_shown_.end - input_shown_.begin);
    const auto output = figure.output_curve.segment(output_shown_.begin, output_shown_.end - output_shown_.begin);
    const double range = std::max({spread(input), spread(output), kLeastRange}) * kHeadroom;
    input_band_ = band(input, top_, range);
    output_band_ = band(output, top_ + kBandHeight + kBandGap, range);
    seconds_ = std::max({figure.close.input.length(), figure.close.output.length(), 1e-3});
  }

  double draw() {
    both_panel(kFigureLeft);
    double left = kFigureLeft;
    const auto& [first, second] = figure_.compared_first ? std::pair(&figure_.compared, &figure_.chosen)
                                                         : std::pair(&figure_.chosen, &figure_.compared);
    for (const AlignFigure::Warp* warp : {first, second}) warped_panel(left += kPanelWidth + kPanelGap, *warp);
    return bottom() + kAxisHeight;
  }

 private:
  static double spread(const Eigen::Ref<const Eigen::VectorXd>& values) {
    return values.maxCoeff() - values.minCoeff();
  }
  static Scale band(const Eigen::Ref<const Eigen::VectorXd>& values, double top, double range) {
    const double middle = 0.5 * (values.maxCoeff() + values.minCoeff());
    return {middle - 0.5 * range, middle + 0.5 * range, top + kBandHeight, top};
  }
  [[nodiscard]] double bottom() const { return top_ + 2 * kBandHeight + kBandGap; }

  /// Time [s] along a panel, that `begin` is at its left edge.
  [[nodiscard]] Scale time(double left, double begin) const {
    return {begin, begin + seconds_, left, left + kPanelWidth};
  }

  [[nodiscard]] double output_value(double frame) const {
    const auto& curve = figure_.output_curve;
    const auto before = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(frame), 0, curve.size() - 1);
    const Eigen::Index after = std::min(before + 1, curve.size() - 1);
    const double weight = frame - static_cast<double>(before);
    return (1.0 - weight) * curve[before] + weight * curve[after];
  }

  /// The input's curve where `at(frame)` [frames] puts its frames on `x`.
  template <typename Place>
  void input_curve(const Scale& x, Place at) {
    std::vector<Point> points;
    for (Eigen::Index t = input_shown_.begin; t < input_shown_.end; ++t) {
      points.push_back({x.at(at(t) / figure_.frame_rate), input_band_.at(figure_.input_curve[t])});
    }
    svg_.curve(points, fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", kInputColor));
  }
  void output_curve(const Scale& x) {
    std::vector<Point> points;
    for (Eigen::Index t = output_shown_.begin; t < output_shown_.end; ++t) {
      points.push_back({x.at(static_cast<double>(t) / figure_.frame_rate), output_band_.at(figure_.output_curve[t])});
    }
    svg_.curve(points, fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", kOutputColor));
  }

  /// Lines from the input's frames to the moments of the output they belong to.
  template <typename Place>
  void ties(const Scale& x, Place at, const Scale& output_x, const Eigen::VectorXd& output_time) {
    const Eigen::Index every = 1 + (input_shown_.end - input_shown_.begin - 1) / kMostTies;
    svg_.begin_group("stroke=\"#9a9a9a\" stroke-width=\"0.5\"");
    for (Eigen::Index t = input_shown_.begin; t < input_shown_.end; t += every) {
      svg_.line({x.at(at(t) / figure_.frame_rate), input_band_.at(figure_.input_curve[t])},
                {output_x.at(output_time[t] / figure_.frame_rate), output_band_.at(output_value(output_time[t]))});
    }
    svg_.end_group();
  }

  void axes(double left, const std::string& title, const Scale& x, const std::string& time_of) {
    draw_title(svg_, left, top_ - 7.0, title);
    svg_.axis_below(x, bottom(), time_of, 4);
  }

  void both_panel(double left) {
    const Scale x = time(left, figure_.close.input.begin), output_x = time(left, figure_.close.output.begin);
    const bool one_axis = x.low == output_x.low;
    axes(left, "Correspondence by " + figure_.chosen.title, output_x,
         one_axis ? "time [s]" : fmt::format("output's time [s]; the input's from {:.3g} s", x.low));
    svg_.axis_left(input_band_, left, "", 4);
    svg_.axis_left(output_band_, left, "", 4);
    svg_.text_upwards({left - 42.0, 0.5 * (top_ + bottom())}, figure_.quantity);
    const auto own = [](Eigen::Index t) { return static_cast<double>(t); };
    clipped(left, [&] {
      ties(x, own, output_x, figure_.chosen.output_time);
      input_curve(x, own);
      output_curve(output_x);
    });
  }

  void warped_panel(double left, const AlignFigure::Warp& warp) {
    const Scale x = time(left, figure_.close.output.begin);
    axes(left, "Time-warped by " + warp.title, x, "output's time [s]");
    const auto warped = [&](Eigen::Index t) { return warp.output_time[t]; };
    clipped(left, [&] {
      ties(x, warped, x, warp.output_time);
      input_curve(x, warped);
      output_curve(x);
    });
  }

  template <typename Draw>
  void clipped(double left, Draw draw) {
    svg_.begin_clip({left, top_ - 1.0}, kPanelWidth + 1.0, bottom() - top_ + 1.0);
    draw();
    svg_.end_clip();
  }

  Svg& svg_;
  const AlignFigure& figure_;
  double top_, seconds_ = 1.0;
  Shown input_shown_, output_shown_;
  Scale input_band_, output_band_;
};

}  // namespace

double draw_curves(Svg& svg, const AlignFigure& figure, double top) {
  return Curves(svg, figure, top).draw();
}

}  // namespace strut::cli
