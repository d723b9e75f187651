// SPDX-License-Identifier: MIT
// What is measured of one clip: foot slide, smoothness, gait. One implementation for strut measure, the viewer and
// reports; from a motion and its footplants to the figures, and from those to the list that a page shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <strut/metrics/foot_slide.h>
#include <strut/metrics/gait.h>
#include <strut/metrics/smoothness.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::cli {

inline constexpr double kCmPerMetre = 100.0;

/// What was measured of one clip.
struct ClipMeasures {
  metrics::FootSlide slide;
  metrics::FootSlide planted;  ///< in `num_footplants` footplants
  int num_footplants = 0;
  metrics::Smoothness smoothness;
  metrics::Gait gait;
};

/// Measures `motion`, whose feet stand as `plants` says, at its measuring rate. Throws InvalidArgument for a body
/// without two legs and for fewer than four frames. Cost O(frames x joints).
ClipMeasures measure_clip(const Motion& motion, const std::vector<motion::Footplant>& plants);

/// The name of `joint`, or its number where it has none; empty for -1.
std::string joint_name(const Motion& motion, int joint);

/// Where a figure is at its most extreme.
struct Extreme {
  std::string what;    ///< "highest", "longest step", ...
  double value = 0.0;  ///< in the figure's unit, unless it says otherwise
  std::string unit;
  std::string joint;  ///< empty if no single joint is meant
  int frame = 0;      ///< of the clip, from 0
  double time = 0.0;  ///< after the first frame [s]
};

/// A figure as a person reads it.
struct ClipFigure {
  std::string name;
  std::optional<double> value;  ///< none: `note` says why
  std::string unit;
  std::string better{};  ///< "less", "more"; empty where it cannot be said
  std::string note{};
  std::optional<Extreme> extreme{};
};

/// The figures of `motion`, each with its extreme. Where there is nothing to measure (no two legs, too few frames) they
/// have no values, and a note that says why. Cost O(frames x joints).
std::vector<ClipFigure> clip_figures(const Motion& motion, const std::vector<motion::Footplant>& plants);

/// As Figure of viewer/src/data/types.ts.
nlohmann::ordered_json as_json(const std::vector<ClipFigure>& figures);

}  // namespace strut::cli
