// SPDX-License-Identifier: MIT
// When each foot stands, in the input above and in the output below, each clip stretched over the panel. A line leads
// from where a foot comes down in the input to where the alignment puts that moment in the output; a black bar from
// there to where the same foot comes down is the error.
#include "align_figure.h"

#include <algorithm>

namespace strut::cli {
namespace {

constexpr double kTitleHeight = 18.0, kUpperAxis = 26.0, kLowerAxis = 32.0, kNoteHeight = 16.0;
constexpr double kBarHeight = 8.0, kTieHeight = 30.0, kFootGap = 16.0;
constexpr double kErrorHeight = 4.0;
constexpr std::size_t kMostTies = 400;
constexpr const char* kFeet[] = {"left", "right"};

/// The places of one foot's parts.
struct Lane {
  double input = 0.0, output = 0.0;  ///< tops of the bars
};

class Footplants {
 public:
  Footplants(Svg& svg, const AlignFigure& figure, double top)
      : svg_(svg),
        figure_(figure),
        top_(top + kTitleHeight + kUpperAxis),
        input_{figure.close.input.begin, figure.close.input.end, kFigureLeft, kFigureWidth - kFigureRight},
        output_{figure.close.output.begin, figure.close.output.end, kFigureLeft, kFigureWidth - kFigureRight} {}

  double draw() {
    draw_title(svg_, kFigureLeft, top_ - kUpperAxis - 7.0, "Footplants");
    svg_.text({kFigureWidth - kFigureRight, top_ - kUpperAxis - 7.0}, errors(),
              "text-anchor=\"end\" font-size=\"9.5\"");
    svg_.axis_above(input_, top_ - 4.0, "", 8);
    svg_.text({kFigureLeft - 6.0, top_ - 10.0}, "input [s]", "text-anchor=\"end\" font-size=\"9\"");
    svg_.axis_below(output_, bottom() + 4.0, "", 8);
    svg_.text({kFigureLeft - 6.0, bottom() + 17.0}, "output [s]", "text-anchor=\"end\" font-size=\"9\"");
    svg_.begin_clip({kFigureLeft, top_ - 3.0}, kFigureWidth - kFigureRight - kFigureLeft, bottom() - top_ + 6.0);
    for (const int foot : {0, 1}) draw_foot(foot);
    svg_.end_clip();
    for (const int foot : {0, 1}) {
      svg_.text({kFigureLeft - 6.0, lane(foot).input + kBarHeight + 0.5 * kTieHeight + 3.0}, kFeet[foot],
                "text-anchor=\"end\"");
    }
    svg_.text({kFigureLeft, bottom() + kLowerAxis + 2.0},
              "Line: where the alignment puts a foot's coming down. Black: from there to where it comes down in the "
              "output. \u00d7: without counterpart.",
              "font-size=\"8.5\" fill=\"#555\"");
    return bottom() + kLowerAxis + kNoteHeight - 6.0;
  }

 private:
  [[nodiscard]] Lane lane(int foot) const {
    const double at = top_ + foot * (2.0 * kBarHeight + kTieHeight + kFootGap);
    return {at, at + kBarHeight + kTieHeight};
  }
  [[nodiscard]] double bottom() const { return lane(1).output + kBarHeight; }
  [[nodiscard]] double seconds(double frames) const { return frames / figure_.frame_rate; }

  [[nodiscard]] bool is_shown(double frame, const Scale& x) const {
    return seconds(frame) >= x.low && seconds(frame) <= x.high;
  }

  [[nodiscard]] std::string errors() const {
    const auto &found = figure_.chosen.onsets, &other = figure_.compared.onsets;
    if (!found || found->num_pairs == 0) return "no foot comes down in both clips";
    std::string text =
        fmt::format("mean error {:.0f} ms, largest {:.0f} ms, {} of {} paired", 1e3 * seconds(found->mean),
                    1e3 * seconds(found->largest), found->num_pairs, found->onsets.size());
    if (other && other->num_pairs > 0) {
      text += fmt::format("; by {}: mean {:.0f} ms, {} paired", figure_.compared.title, 1e3 * seconds(other->mean),
                          other->num_pairs);
    }
    return text;
  }

  void bars(const std::vector<motion::Footplant>& plants, int foot, const Scale& x, double top, const char* color) {
    svg_.line({x.from, top + 0.5 * kBarHeight}, {x.to, top + 0.5 * kBarHeight}, "stroke=\"#ccc\" stroke-width=\"0.6\"");
    for (const motion::Footplant& plant : plants) {
      if (plant.foot != foot || seconds(plant.end) < x.low || seconds(plant.begin) > x.high) continue;
      const double from = x.at(seconds(plant.begin)), to = x.at(seconds(plant.end));
      svg_.box({from, top}, to - from, kBarHeight, fmt::format("fill=\"{}\"", color));
    }
  }

  /// A small cross about `at`.
  void cross(Point at) {
    for (const double slope : {-1.0, 1.0}) {
      svg_.line({at.x - 2.5, at.y - 2.5 * slope}, {at.x + 2.5, at.y + 2.5 * slope},
                "stroke=\"#111\" stroke-width=\"1.1\"");
    }
  }

  void draw_foot(int foot) {
    const Lane at = lane(foot);
    bars(*figure_.plants.input, foot, input_, at.input, kInputColor);
    bars(*figure_.plants.output, foot, output_, at.output, kOutputColor);
    const auto& found = figure_.chosen.onsets;
    if (!found ||
        static_cast<std::size_t>(std::count_if(found->onsets.begin(), found->onsets.end(),
                                               [&](const auto& o) { return is_shown(o.input, input_); })) > kMostTies) {
      return;
    }
    for (const OnsetPair& onset : found->onsets) {
      if (onset.foot == foot && is_shown(onset.input, input_)) tie(onset, at);
    }
    for (const OnsetPair& onset : found->unpaired) {
      if (onset.foot == foot && is_shown(onset.output, output_))
        cross({output_.at(seconds(onset.output)), at.output - 5.0});
    }
  }

  void tie(const OnsetPair& onset, const Lane& at) {
    const double from = input_.at(seconds(onset.input)), to = output_.at(seconds(onset.mapped));
    svg_.line({from, at.input}, {to, at.output - kErrorHeight}, "stroke=\"#333\" stroke-width=\"0.9\"");
    if (!onset.is_paired) return cross({to, at.output - 5.0});
    const double own = output_.at(seconds(onset.output));
    svg_.line({to, at.output - kErrorHeight}, {to, at.output + kBarHeight}, "stroke=\"#111\" stroke-width=\"0.9\"");
    svg_.box({std::min(own, to), at.output - kErrorHeight}, std::abs(own - to), kErrorHeight, "fill=\"#111\"");
  }

  Svg& svg_;
  const AlignFigure& figure_;
  double top_;
  Scale input_, output_;
};

}  // namespace

double draw_footplants(Svg& svg, const AlignFigure& figure, double top) {
  if (figure.plants.input && figure.plants.output) return Footplants(svg, figure, top).draw();
  draw_title(svg, kFigureLeft, top + kTitleHeight - 7.0, "Footplants");
  svg.text({kFigureLeft + 64.0, top + kTitleHeight - 7.0}, figure.no_plants);
  return top + kTitleHeight;
}

}  // namespace strut::cli
