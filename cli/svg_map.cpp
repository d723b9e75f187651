// SPDX-License-Identifier: MIT
// Maps of shades. A raster would need a compressor; a vector map of runs needs none, and a zoomed or printed figure
// keeps its cells sharp.
#include "svg.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strut::cli {
namespace {

constexpr double kLightest = 0.985, kDarkest = 0.36;  // OKLab lightness: readable under black lines, and in grey
constexpr double kHue = 4.45;                         // blue [rad]
constexpr double kChroma = 0.115;                     // within sRGB at every lightness used
constexpr double kOverlap = 1.06;                     // of rows: viewers that smooth edges show no seams between them

double srgb(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

int shade_of(double value) {
  return std::clamp(static_cast<int>(value * kShades), 0, kShades - 1);
}

/// Calls `draw(shade, row, begin, end)` for every run of cells of one shade in a row.
template <typename Draw>
void each_run(const FrameMatrix& values, Draw draw) {
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index begin = 0, end = 0; begin < values.cols(); begin = end) {
      const int shade = shade_of(values(row, begin));
      while (end < values.cols() && shade_of(values(row, end)) == shade) ++end;
      draw(shade, row, begin, end);
    }
  }
}

}  // namespace

std::string shade(double darkness) {
  const double lightness = kLightest + darkness * (kDarkest - kLightest);
  const double chroma = kChroma * std::sqrt(std::clamp(1.6 * darkness, 0.0, 1.0));
  const double a = chroma * std::cos(kHue), b = chroma * std::sin(kHue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
  const std::array<double, 3> linear{4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                     -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                     -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  std::string color = "#";
  for (const double channel : linear)
    color += fmt::format("{:02x}", static_cast<int>(std::lround(255 * srgb(channel))));
  return color;
}

std::size_t num_runs(const FrameMatrix& values) {
  std::size_t runs = 0;
  each_run(values, [&](int, Eigen::Index, Eigen::Index, Eigen::Index) { ++runs; });
  return runs;
}

void draw_map(Svg& svg, const FrameMatrix& values, Point corner, double width, double height) {
  const double across = width / static_cast<double>(values.cols()), up = height / static_cast<double>(values.rows());
  svg.box(corner, width, height, fmt::format("fill=\"{}\"", shade(0.5 / kShades)));
  svg.begin_clip(corner, width, height);
  svg.add(
      "<g transform=\"translate({:.2f} {:.2f}) scale({:.5f} {:.5f})\" fill=\"none\" stroke-width=\"{}\" "
      "shape-rendering=\"crispEdges\">\n",
      corner.x, corner.y + height - 0.5 * up, across, -up, kOverlap);
  std::array<std::string, kShades> paths;
  each_run(values, [&](int shade, Eigen::Index row, Eigen::Index begin, Eigen::Index end) {
    if (shade == 0) return;  // as the ground
    fmt::format_to(std::back_inserter(paths[static_cast<std::size_t>(shade)]), "M{} {}h{}", begin, row, end - begin);
  });
  for (int k = 1; k < kShades; ++k) {
    const std::string& path = paths[static_cast<std::size_t>(k)];
    if (!path.empty()) svg.add("<path stroke=\"{}\" d=\"{}\"/>\n", shade((k + 0.5) / kShades), path);
  }
  svg.end_group();
  svg.end_clip();
}

}  // namespace strut::cli
