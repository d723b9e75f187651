// SPDX-License-Identifier: MIT
// The demo's still picture: poses of input, output and true answer over time, below them when the feet stand. One SVG
// file that loads nothing.
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

/// The picture, SVG: a row per clip with a pose every tenth of a second from the time `begins[i]` [s] on, and when the
/// feet stand. `title` says what it shows. Light or dark as its reader likes.
std::string demo_picture(const std::string& title, const std::vector<DemoClip>& clips,
                         const std::vector<double>& begins);

}  // namespace strut::cli
