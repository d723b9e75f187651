// SPDX-License-Identifier: MIT
// Every frame of the input against every frame of the output: how far they are apart, and the paths the methods took
// through it. The second map is of the input as it looks after the spatial warp, where there is one.
#include "align_figure.h"

#include <algorithm>
#include <cmath>

namespace strut::cli {
namespace {

constexpr double kTitleHeight = 18.0, kAxisHeight = 32.0, kMapWidth = 266.0, kMapGap = 46.0;
constexpr double kFlattest = 0.55, kSteepest = 1.05;  // height over width
constexpr double kCasing = 3.4;                       // white around a line, that it stands out from any shade

struct Box {
  double left, top, width, height;
};

class Maps {
 public:
  Maps(Svg& svg, const AlignFigure& figure, double top) : svg_(svg), figure_(figure), top_(top + kTitleHeight) {
    const double ratio = figure.mapped.output.length() / figure.mapped.input.length();
    height_ = kMapWidth * std::clamp(ratio, kFlattest, kSteepest);
  }

  double draw() {
    double left = kFigureLeft;
    for (const AlignFigure::Map& map : figure_.maps) {
      draw_map_panel({left, top_, kMapWidth, height_}, map, left == kFigureLeft);
      left += kMapWidth + kMapGap;
    }
    shade_bar({left - kMapGap + 14.0, top_, 9.0, height_});
    return top_ + height_ + kAxisHeight;
  }

 private:
  void draw_map_panel(const Box& box, const AlignFigure::Map& map, bool is_first) {
    const double half = 0.5 / figure_.frame_rate;  // a cell is a frame wide and centred on it
    const auto& [input, output] = figure_.mapped;
    const Scale x{input.begin - half, input.end + half, box.left, box.left + box.width};
    const Scale y{output.begin - half, output.end + half, box.top + box.height, box.top};
    draw_title(svg_, box.left, box.top - 7.0, map.title);
    draw_map(svg_, (map.distances / figure_.darkest).cwiseMin(1.0), {box.left, box.top}, box.width, box.height);
    svg_.begin_clip({box.left, box.top}, box.width, box.height);
    slope_limit(x, y);
    path(x, y, figure_.even, kEvenLine, 0.0);
    path(x, y, figure_.compared.output_time, kComparedLine, 2.6);
    path(x, y, figure_.chosen.output_time, kChosenLine, kCasing);
    svg_.end_clip();
    svg_.axis_below(x, box.top + box.height, "input's time [s]");
    svg_.axis_left(y, box.left, is_first ? "output's time [s]" : "");
  }

  /// What the slope limit leaves to a path: the cone from a fixed beginning and that to a fixed end. Both are at the
  /// edges of the first and last frames.
  void slope_limit(const Scale& x, const Scale& y) {
    const double limit = figure_.chosen.slope_limit, half = 0.5 / figure_.frame_rate;
    if (limit <= 1.0) return;
    const double in = static_cast<double>(figure_.chosen.output_time.size()) / figure_.frame_rate;
    const double out = static_cast<double>(figure_.output_curve.size()) / figure_.frame_rate;
    for (const double slope : {limit, 1.0 / limit}) {
      // Where the edge from the beginning meets that to the end, which has the other slope.
      const double other = 1.0 / slope;
      const double meets = std::clamp((out - other * in) / (slope - other), 0.0, in);
      std::vector<Point> edge;
      if (figure_.begins_fixed) edge.push_back({0.0, 0.0});
      if (figure_.begins_fixed && figure_.ends_fixed) edge.push_back({meets, slope * meets});
      if (figure_.begins_fixed && !figure_.ends_fixed) edge.push_back({in, slope * in});
      if (!figure_.begins_fixed && figure_.ends_fixed) edge.push_back({0.0, out - slope * in});
      if (figure_.ends_fixed) edge.push_back({in, out});
      for (Point& point : edge) point = {x.at(point.x - half), y.at(point.y - half)};
      if (edge.empty()) return;
      for (const char* line : {"stroke=\"#fff\" stroke-width=\"2.4\"", kLimitLine}) svg_.curve(edge, line);
    }
  }

  void path(const Scale& x, const Scale& y, const Eigen::VectorXd& output_time, const char* line, double casing) {
    std::vector<Point> points;
    for (Eigen::Index t = 0; t < output_time.size(); ++t) {
      const double time = static_cast<double>(t) / figure_.frame_rate;
      if (time < figure_.mapped.input.begin || time > figure_.mapped.input.end) continue;
      points.push_back({x.at(time), y.at(output_time[t] / figure_.frame_rate)});
    }
    if (casing > 0.0) svg_.curve(points, fmt::format("stroke=\"#fff\" stroke-width=\"{}\"", casing));
    svg_.curve(points, line);
  }

  void shade_bar(const Box& box) {
    const double step = box.height / kShades;
    for (int k = 0; k < kShades; ++k) {
      svg_.box({box.left, box.top + box.height - (k + 1) * step}, box.width, step + (k > 0 ? 0.3 : 0.0),
               fmt::format("fill=\"{}\"", shade((k + 0.5) / kShades)));
    }
    const Scale y{0.0, figure_.darkest, box.top + box.height, box.top};
    svg_.begin_group("stroke=\"#333\" stroke-width=\"0.7\"");
    svg_.box({box.left, box.top}, box.width, box.height, "fill=\"none\"");
    for (const Tick& tick : ticks(y, 5)) {
      svg_.line({box.left + box.width, y.at(tick.value)}, {box.left + box.width + 3.0, y.at(tick.value)});
    }
    svg_.end_group();
    for (const Tick& tick : ticks(y, 5)) svg_.text({box.left + box.width + 5.0, y.at(tick.value) + 3.3}, tick.label);
    svg_.text_upwards({box.left + box.width + 36.0, box.top + 0.5 * box.height},
                      "squared distance [deviations\u00b2], darkest: this or more");
  }

  Svg& svg_;
  const AlignFigure& figure_;
  double top_, height_ = 0.0;
};

}  // namespace

double draw_maps(Svg& svg, const AlignFigure& figure, double top) {
  return Maps(svg, figure, top).draw();
}

}  // namespace strut::cli
