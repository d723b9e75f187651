// SPDX-License-Identifier: MIT
// Real clips aligned: the landings and lift-offs of both feet of pieces of two gait cycles, mapped through the warp.
#pragma once

#include "correspondence_methods.h"
#include "foot_events.h"

#include <string>
#include <vector>

namespace strut::study {

/// Which takes are looked at.
enum class Takes {
  kLearnt,   ///< 001 to 012, on which settings are chosen
  kHeldOut,  ///< 013 to 017
};

/// The clips of one content in the plain style and another.
struct Cell {
  std::string content, style;
  std::vector<Motion> input, output;
};

/// FOLDER/dataset-2_CONTENT_STYLE_TAKE.bvh.
Cell read_cell(const std::string& folder, const std::string& content, const std::string& style, Takes takes);

/// What one method did.
struct ClipFigures {
  Figures landings, leavings, all;
};

/// Judges all `methods` on the matched pieces of a cell.
std::vector<ClipFigures> judge(const Cell& cell, EventKind kind, const std::vector<Method>& methods);

/// The mean over pairs of least_mean_error.
double least_mean_error(const Cell& cell, EventKind kind, double slope_limit, bool landings_alone);

}  // namespace strut::study
