// SPDX-License-Identifier: MIT
// What a scientific figure is drawn with: text, lines, curves, axes with round ticks, and maps of shades, as SVG that
// stands alone (presentation attributes only: no styles, scripts or fonts from outside) and stays small however long
// the data is. Lengths on the page are in the figure's user units, y downwards.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include <strut/math/frame_matrix.h>

namespace strut::cli {

/// A place on the page.
struct Point {
  double x = 0.0, y = 0.0;
};

/// Text as it may stand in XML: & < > and quotes spelt out, control characters replaced.
std::string escaped(const std::string& text);

/// `text` with its middle replaced by an ellipsis if it has more than `most` characters; the end, which tells files
/// apart, is kept longest. UTF-8 is never cut within a character.
std::string shortened(const std::string& text, std::size_t most);

/// From values to places along one direction of the page.
struct Scale {
  double low = 0.0, high = 1.0;  ///< values at the ends, low < high; above 0 if logarithmic
  double from = 0.0, to = 1.0;   ///< where they lie on the page
  bool logarithmic = false;

  [[nodiscard]] double at(double value) const;
};

/// A value that is marked on an axis, and how it is written.
struct Tick {
  double value = 0.0;
  std::string label;
};

/// Round values within a scale, about `count`: 1, 2 or 5 times a power of ten apart. On a logarithmic scale powers of
/// two, or of ten where it is wide.
std::vector<Tick> ticks(const Scale& scale, int count);

/// A picture that is being drawn.
class Svg {
 public:
  explicit Svg(double width) : width_(width) {}

  /// Appends SVG as it is.
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(body_), format, std::forward<Args>(args)...);
  }

  /// `attributes` here and below: SVG's, e.g. `text-anchor="middle"`; of a group they hold for all that is in it.
  void begin_group(const std::string& attributes) { add("<g {}>\n", attributes); }
  void end_group() { add("</g>\n"); }

  void text(Point at, const std::string& text, const std::string& attributes = {});
  /// Text that runs upwards, about `at`.
  void text_upwards(Point at, const std::string& text);
  void line(Point from, Point to, const std::string& attributes = {});
  void box(Point corner, double width, double height, const std::string& attributes);
  /// A curve through `points` with ascending x, thinned where there are more than the page can show.
  void curve(const std::vector<Point>& points, const std::string& attributes);

  /// Axes with round ticks, about `count`, and a label: below or above a plot along `x`, at height `y`, and at its left
  /// along `y`, at `x`.
  void axis_below(const Scale& x, double y, const std::string& label, int count = 5);
  void axis_above(const Scale& x, double y, const std::string& label, int count = 5);
  void axis_left(const Scale& y, double x, const std::string& label, int count = 5);

  /// Everything drawn until end_clip is cut off at this box.
  void begin_clip(Point corner, double width, double height);
  void end_clip() { end_group(); }

  [[nodiscard]] double width() const noexcept { return width_; }

  /// The file: white ground, a title for those who cannot see it.
  [[nodiscard]] std::string finish(double height, const std::string& title, const std::string& description) const;

 private:
  void axis_along(const Scale& x, double y, const std::string& label, int count, bool is_above);

  double width_;
  std::string body_;
  int num_clips_ = 0;
};

/// Shades of one hue from near white (0) to dark (1) whose lightness falls evenly, so that equal steps look equal, in
/// grey too (OKLab; Ottosson 2020). As #rrggbb.
std::string shade(double darkness);

/// How many shades a map is drawn in.
inline constexpr int kShades = 16;

/// `values` (rows upwards from the bottom, columns to the right) between 0 and 1 as a map of kShades shades that fills
/// the box. Each shade is one path, a stroke of about nine bytes per run of cells: sharp at any size, and no picture
/// has to be compressed and embedded.
void draw_map(Svg& svg, const FrameMatrix& values, Point corner, double width, double height);

/// How many strokes draw_map needs for these values.
std::size_t num_runs(const FrameMatrix& values);

}  // namespace strut::cli
