// SPDX-License-Identifier: MIT
// A report: the viewer's page with its clips in it, one HTML file that needs neither this program nor a network. From
// clips to the page, whose <script id="report"> holds Report of viewer/src/data/report_source.ts.
#pragma once

#include "clip_figures.h"

#include <string>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/motion/motion.h>

namespace strut::cli {

/// A clip of a report.
struct ReportClip {
  std::string name;
  Motion motion;
  Diagnostics notes{};                ///< what reading it had to say
  std::vector<ClipFigure> figures{};  ///< put before those that are measured
};

/// Which curves a report holds.
enum class ReportCurves {
  kFitting,  ///< all, or, where they would take more than kCurveBudget, those of the body as a whole
  kBody,
  kAll,
};

/// How much the curves of a report may take unless all are asked for [bytes].
inline constexpr double kCurveBudget = 8e6;

/// What a report says beside its clips.
struct ReportOptions {
  std::string title;
  std::vector<std::string> notes{};  ///< paragraphs
  bool align = true;                 ///< clips with the first clip's skeleton to the first clip
  ReportCurves curves = ReportCurves::kFitting;
};

/// The page. Positions are off by kLargestPackingError at most, curves by 1/130000 of their range. What was left out (a
/// clip that cannot be aligned, curves that take too much) is said on it. The same clips and options make
/// the same bytes. Throws what measuring and aligning do, but for a clip that has nothing to be measured or aligned.
std::string report_page(const std::vector<ReportClip>& clips, const ReportOptions& options);

}  // namespace strut::cli
