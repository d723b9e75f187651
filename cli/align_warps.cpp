// SPDX-License-Identifier: MIT
// The warp over time: where it puts the input's frames, how far that is from an even stretch, and how many output
// frames pass per input frame. Rings are footplants: a foot comes down in the input (across) and in the output (up).
#include "align_figure.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace strut::cli {
namespace {

constexpr double kTitleHeight = 18.0, kAxisHeight = 32.0, kPanelHeight = 112.0, kPanelGap = 48.0;
constexpr double kPanelWidth = (kFigureWidth - kFigureLeft - kFigureRight - 2.0 * kPanelGap) / 3.0;
constexpr double kUnlimitedSlope = 4.0;  // what is shown of a slope without limit
constexpr double kBeyondLimit = 1.3;     // what is shown beyond a limit

class Warps {
 public:
  Warps(Svg& svg, const AlignFigure& figure, double top) : svg_(svg), figure_(figure), top_(top + kTitleHeight) {}

  double draw() {
    double left = kFigureLeft;
    warp_panel(left);
    difference_panel(left += kPanelWidth + kPanelGap);
    slope_panel(left += kPanelWidth + kPanelGap);
    return top_ + kPanelHeight + kAxisHeight;
  }

 private:
  using Values = std::function<double(Eigen::Index)>;

  [[nodiscard]] static Scale time(double left, const FigureWindow& window) {
    return {window.input.begin, window.input.end, left, left + kPanelWidth};
  }
  [[nodiscard]] Scale up(double low, double high, bool logarithmic = false) const {
    return {low, high, top_ + kPanelHeight, top_, logarithmic};
  }
  [[nodiscard]] double seconds(double frames) const { return frames / figure_.frame_rate; }
  [[nodiscard]] bool is_shown(double time) const {
    return time >= figure_.whole.input.begin && time <= figure_.whole.input.end;
  }

  void curve(const Scale& x, const Scale& y, const char* line, const Values& value) {
    std::vector<Point> points;
    for (Eigen::Index t = 0; t < figure_.even.size(); ++t) {
      const double at = seconds(static_cast<double>(t));
      if (at >= x.low && at <= x.high) points.push_back({x.at(at), y.at(value(t))});
    }
    svg_.curve(points, line);
  }

  /// A ring per paired footplant where `value` of its times [s] in input and output puts it.
  void rings(const Scale& x, const Scale& y, const std::function<double(double, double)>& value) {
    if (!figure_.chosen.onsets || figure_.chosen.onsets->onsets.size() > kMostRings) return;
    svg_.begin_group("stroke=\"#cc4c02\" stroke-width=\"1\" fill=\"#fff\"");
    for (const OnsetPair& onset : figure_.chosen.onsets->onsets) {
      const double at = seconds(onset.input);
      if (!onset.is_paired || !is_shown(at)) continue;
      svg_.add("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.3\"{}/>\n", x.at(at), y.at(value(onset.input, onset.output)),
               onset.foot == 0 ? " fill=\"#cc4c02\"" : "");
    }
    svg_.end_group();
  }

  void axes(const Scale& x, const Scale& y, const std::string& title, const std::string& label) {
    draw_title(svg_, x.from, top_ - 7.0, title);
    svg_.axis_below(x, top_ + kPanelHeight, "input's time [s]", 5);
    svg_.axis_left(y, x.from, label, 4);
  }

  void clip(const Scale& x) { svg_.begin_clip({x.from, top_ - 1.0}, kPanelWidth, kPanelHeight + 2.0); }

  void warp_panel(double left) {
    const Scale x = time(left, figure_.whole), y = up(figure_.whole.output.begin, figure_.whole.output.end);
    axes(x, y, "Time warp", "output's time [s]");
    clip(x);
    curve(x, y, kEvenLine, [&](Eigen::Index t) { return seconds(figure_.even[t]); });
    curve(x, y, kComparedLine, [&](Eigen::Index t) { return seconds(figure_.compared.output_time[t]); });
    curve(x, y, kChosenLine, [&](Eigen::Index t) { return seconds(figure_.chosen.output_time[t]); });
    rings(x, y, [&](double, double output) { return seconds(output); });
    svg_.end_clip();
  }

  [[nodiscard]] double even_at(double input_frame) const {
    return figure_.even[static_cast<Eigen::Index>(input_frame)];
  }

  void difference_panel(double left) {
    double low = 0.0, high = 0.0;
    const auto include = [&](double difference) {
      low = std::min(low, difference);
      high = std::max(high, difference);
    };
    for (Eigen::Index t = 0; t < figure_.even.size(); ++t) {
      if (!is_shown(seconds(static_cast<double>(t)))) continue;
      include(seconds(figure_.chosen.output_time[t] - figure_.even[t]));
      include(seconds(figure_.compared.output_time[t] - figure_.even[t]));
    }
    if (figure_.chosen.onsets) {
      for (const OnsetPair& onset : figure_.chosen.onsets->onsets) {
        if (onset.is_paired && is_shown(seconds(onset.input))) include(seconds(onset.output - even_at(onset.input)));
      }
    }
    const double room = std::max(0.06 * (high - low), 0.5 / figure_.frame_rate);
    const Scale x = time(left, figure_.whole), y = up(low - room, high + room);
    axes(x, y, "Against an even stretch", "later by [s]");
    clip(x);
    curve(x, y, kEvenLine, [](Eigen::Index) { return 0.0; });
    curve(x, y, kComparedLine,
          [&](Eigen::Index t) { return seconds(figure_.compared.output_time[t] - figure_.even[t]); });
    curve(x, y, kChosenLine, [&](Eigen::Index t) { return seconds(figure_.chosen.output_time[t] - figure_.even[t]); });
    rings(x, y, [&](double input, double output) { return seconds(output - even_at(input)); });
    svg_.end_clip();
  }

  void slope_panel(double left) {
    const double limit = figure_.chosen.slope_limit;
    const double mean = figure_.chosen.slope.mean();
    const double most =
        limit > 0.0 ? std::max(limit * kBeyondLimit, 1.5) : kUnlimitedSlope * std::max(mean, 1.0 / mean);
    const Scale x = time(left, figure_.close), y = up(1.0 / most, most, true);
    axes(x, y, "Slope", "output / input frames");
    clip(x);
    const auto level = [&](double value, const char* line) {
      svg_.line({x.from, y.at(value)}, {x.to, y.at(value)}, line);
    };
    if (limit > 0.0) {
      level(limit, kLimitLine);
      level(1.0 / limit, kLimitLine);
    }
    level(mean, kEvenLine);
    curve(x, y, "stroke=\"#b5b5b5\" stroke-width=\"0.6\"", [&](Eigen::Index t) { return figure_.chosen.slope[t]; });
    curve(x, y, kComparedLine, [&](Eigen::Index t) { return figure_.compared.smoothed[t]; });
    curve(x, y, kChosenLine, [&](Eigen::Index t) { return figure_.chosen.smoothed[t]; });
    svg_.end_clip();
  }

  Svg& svg_;
  const AlignFigure& figure_;
  double top_;
};

}  // namespace

double draw_warps(Svg& svg, const AlignFigure& figure, double top) {
  return Warps(svg, figure, top).draw();
}

}  // namespace strut::cli
