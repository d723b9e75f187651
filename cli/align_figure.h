// SPDX-License-Identifier: MIT
// An alignment as a figure for a paper: what is drawn, and its parts. (a) the curves of Figure 2 of Hsu et al. 2005,
// (b) how far the frames are apart, with the paths found there, (c) the warp and its slope over time, (d) the
// footplants. White ground, vector text, no scripts; blue and vermilion are told apart by colour-blind eyes and in
// grey.
#pragma once

#include "align_events.h"
#include "svg.h"

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::cli {

/// A stretch of time [s].
struct Span {
  double begin = 0.0, end = 0.0;
  [[nodiscard]] double length() const noexcept { return end - begin; }
};

/// A part of the input and the part of the output it belongs to.
struct FigureWindow {
  Span input, output;
};

/// All that is drawn of two aligned clips. Times in frames unless said otherwise.
struct AlignFigure {
  /// A method's answer.
  struct Warp {
    std::string title;
    Eigen::VectorXd output_time;  ///< of every input frame [output frames]
    Eigen::VectorXd slope;        ///< differential warp (input frames)
    Eigen::VectorXd smoothed;     ///< the same smoothed
    double slope_limit = 0.0;     ///< 0: none
    std::optional<OnsetErrors> onsets{};
  };
  /// Mean squared distances of blocks of frames: a row per block of the output, a column per block of the input.
  struct Map {
    std::string title;
    FrameMatrix distances;
  };
  double frame_rate = 30.0;  ///< of both clips
  std::string input_name, output_name;
  std::string quantity;                       ///< of both curves, with its unit, e.g. "hip x [degrees]"
  Eigen::VectorXd input_curve, output_curve;  ///< a degree of freedom of every frame
  Warp chosen, compared;
  Eigen::VectorXd even;        ///< output time of every input frame if the input were stretched evenly [output frames]
  bool compared_first = true;  ///< the order of the curves' warped panels
  double darkest = 1.0;        ///< the distance from which on the maps are darkest
  std::vector<Map> maps;       ///< of `mapped`
  bool begins_fixed = true, ends_fixed = true;  ///< whether the input's ends must be the output's
  AlignPlants plants;
  std::string no_plants;  ///< why there are none; empty if there are
  FigureWindow mapped;    ///< what the maps show
  FigureWindow whole;     ///< what the warps show
  FigureWindow close;     ///< what curves, slope and footplants show: of long clips a beginning
  std::vector<std::string> caption;
};

/// What of the figure is drawn.
enum class FigurePart { kAll, kCurves, kMatrix, kWarp, kFootplants };

/// The figure or one part of it as SVG. Cost O(frames); size bounded whatever the clips' length.
std::string draw_alignment(const AlignFigure& figure, FigurePart part);

// ---- the parts; each draws itself below `top` and returns where it ends
// -----------------------------------------------

inline constexpr double kFigureWidth = 720.0, kFigureLeft = 52.0, kFigureRight = 14.0;  ///< of the page and its margins
inline constexpr const char* kInputColor = "#0072b2";                                   // blue
inline constexpr const char* kOutputColor = "#d55e00";                                  // vermilion

double draw_curves(Svg& svg, const AlignFigure& figure, double top);
double draw_maps(Svg& svg, const AlignFigure& figure, double top);
double draw_warps(Svg& svg, const AlignFigure& figure, double top);
double draw_footplants(Svg& svg, const AlignFigure& figure, double top);

/// More footplants than this are not marked on the warps: they would hide the curve.
inline constexpr std::size_t kMostRings = 80;

/// How the lines of the methods look, everywhere in the figure.
inline constexpr const char* kChosenLine = "stroke=\"#111\" stroke-width=\"1.6\"";
inline constexpr const char* kComparedLine = "stroke=\"#009e73\" stroke-width=\"1.1\" stroke-dasharray=\"5 2.5\"";
inline constexpr const char* kEvenLine = "stroke=\"#777\" stroke-width=\"0.9\" stroke-dasharray=\"1 2.4\"";
inline constexpr const char* kEvenTitle = "even stretch";
inline constexpr const char* kLimitLine = "stroke=\"#777\" stroke-width=\"0.8\" stroke-dasharray=\"7 2 1.5 2\"";

/// The title of a panel at its left edge.
inline void draw_title(Svg& svg, double left, double baseline, const std::string& title) {
  svg.text({left, baseline}, title, "font-size=\"10.5\" font-weight=\"bold\"");
}

}  // namespace strut::cli
