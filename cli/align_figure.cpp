// SPDX-License-Identifier: MIT
#include "align_figure.h"

namespace strut::cli {
namespace {

constexpr double kMargin = 8.0, kLegendHeight = 18.0, kRowGap = 12.0, kCaptionLine = 12.5;
constexpr double kLetterLeft = 6.0;
constexpr std::size_t kLongestName = 48;   // characters of a file's name in a legend of two
constexpr std::size_t kLongestLine = 120;  // characters of a caption's line
constexpr double kLetterWidth = 5.3;       // about, of the legend's type

/// A key of lines and what they are, from left to right.
class Legend {
 public:
  Legend(Svg& svg, double baseline) : svg_(svg), baseline_(baseline) {}

  void add(const std::string& text, const std::string& line) {
    svg_.line({left_, baseline_ - 3.3}, {left_ + 20.0, baseline_ - 3.3}, line);
    svg_.text({left_ + 25.0, baseline_}, text);
    left_ += 45.0 + kLetterWidth * static_cast<double>(text.size());
  }

 private:
  Svg& svg_;
  double baseline_, left_ = kFigureLeft;
};

double clip_legend(Svg& svg, const AlignFigure& figure, double top) {
  Legend legend(svg, top + 10.0);
  legend.add("input (above): " + shortened(figure.input_name, kLongestName),
             fmt::format("stroke=\"{}\" stroke-width=\"1.8\"", kInputColor));
  legend.add("output (below): " + shortened(figure.output_name, kLongestName),
             fmt::format("stroke=\"{}\" stroke-width=\"1.8\"", kOutputColor));
  return top + kLegendHeight;
}

double method_legend(Svg& svg, const AlignFigure& figure, double top) {
  Legend legend(svg, top + 10.0);
  legend.add(figure.chosen.title, kChosenLine);
  if (figure.compared.title != kEvenTitle) legend.add(figure.compared.title, kComparedLine);
  legend.add(kEvenTitle, kEvenLine);
  if (figure.chosen.slope_limit > 0.0) {
    legend.add(fmt::format("slope limit {:.3g}", figure.chosen.slope_limit), kLimitLine);
  }
  return top + kLegendHeight;
}

/// `text` in lines of at most kLongestLine characters, broken at spaces.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (text.size() - begin > kLongestLine) {
    std::size_t end = text.rfind(' ', begin + kLongestLine);
    if (end == std::string::npos || end <= begin) end = begin + kLongestLine;
    lines.push_back(text.substr(begin, end - begin));
    begin = end + (text[end] == ' ' ? 1 : 0);
  }
  lines.push_back(text.substr(begin));
  return lines;
}

double caption(Svg& svg, const AlignFigure& figure, double top) {
  svg.begin_group("font-size=\"9.5\" fill=\"#444\"");
  for (const std::string& paragraph : figure.caption) {
    for (const std::string& line : lines_of(paragraph)) svg.text({kFigureLeft, top += kCaptionLine}, line);
  }
  svg.end_group();
  return top + 4.0;
}

double letter(Svg& svg, const char* name, double top) {
  svg.text({kLetterLeft, top + 11.0}, name, "font-size=\"11.5\" font-weight=\"bold\"");
  return top;
}

double draw_all(Svg& svg, const AlignFigure& figure) {
  double y = clip_legend(svg, figure, kMargin);
  y = draw_curves(svg, figure, letter(svg, "(a)", y)) + kRowGap;
  y = method_legend(svg, figure, y);
  y = draw_maps(svg, figure, letter(svg, "(b)", y)) + kRowGap;
  y = draw_warps(svg, figure, letter(svg, "(c)", y)) + kRowGap;
  y = draw_footplants(svg, figure, letter(svg, "(d)", y)) + kRowGap;
  return caption(svg, figure, y);
}

double draw_part(Svg& svg, const AlignFigure& figure, FigurePart part) {
  switch (part) {
    case FigurePart::kCurves:
      return draw_curves(svg, figure, clip_legend(svg, figure, kMargin));
    case FigurePart::kMatrix:
      return draw_maps(svg, figure, method_legend(svg, figure, kMargin));
    case FigurePart::kWarp:
      return draw_warps(svg, figure, method_legend(svg, figure, kMargin));
    case FigurePart::kFootplants:
      return draw_footplants(svg, figure, clip_legend(svg, figure, kMargin));
    case FigurePart::kAll:
      break;
  }
  return draw_all(svg, figure);
}

}  // namespace

std::string draw_alignment(const AlignFigure& figure, FigurePart part) {
  Svg svg(kFigureWidth);
  const double height = draw_part(svg, figure, part) + kMargin;
  std::string description;
  for (const std::string& paragraph : figure.caption) description += (description.empty() ? "" : " ") + paragraph;
  return svg.finish(height, figure.input_name + " aligned with " + figure.output_name, description);
}

}  // namespace strut::cli
