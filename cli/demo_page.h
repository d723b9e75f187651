// SPDX-License-Identifier: MIT
// How the demo shows what it did: a page that plays input, output and true answer side by side, and a still picture of
// the same three. Both are one file each that loads nothing.
#pragma once

#include <string>
#include <vector>

#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::cli {

/// One of the clips shown. All are on the walker's skeleton, at one frame rate.
struct DemoClip {
  std::string title;
  std::string note;  ///< what it is, a few words
  Motion motion;
  std::vector<motion::Footplant> plants;
};

/// One line of the table of figures.
struct DemoFigure {
  std::string name;                 ///< with its unit
  std::vector<std::string> values;  ///< one per clip
};

/// What the demo has to show.
struct DemoReport {
  std::string lead;             ///< what the page shows, a sentence or two
  std::vector<DemoClip> clips;  ///< input, output, true answer
  std::vector<DemoFigure> figures;
  std::vector<std::string> facts;  ///< what was done, a sentence each
};

/// The page, HTML.
std::string demo_page(const DemoReport& report);

/// The picture, SVG: a row per clip with a pose every tenth of a second from the time `begins[i]` [s] on, and when the
/// feet stand. Light or dark as its reader likes.
std::string demo_picture(const DemoReport& report, const std::vector<double>& begins);

}  // namespace strut::cli
