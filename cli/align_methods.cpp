// SPDX-License-Identifier: MIT
#include "align_methods.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <strut/align/continuous_warp.h>
#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>
#include <strut/core/error.h>

namespace strut::cli {
namespace {

using representation::AlignmentPair;

double continuous_slope_limit(const AlignSettings& settings) {
  const double limit = settings.slope_limit.value_or(align::ContinuousWarpOptions{}.slope_limit);
  if (limit > 1.0) return limit;
  throw InvalidArgument("--slope-limit", "a number above 1 with --method continuous", fmt::format("{:g}", limit));
}
double papers_slope_limit(const AlignSettings& settings) {
  return settings.slope_limit.value_or(align::TimeWarpOptions{}.slope_limit);
}
double no_slope_limit(const AlignSettings&) {
  return 0.0;
}
double slope_limit_two(const AlignSettings&) {
  return 2.0;
}

align::TimeWarpOptions counted(const AlignSettings& settings) {
  align::TimeWarpOptions options = settings.time;
  options.slope_limit = papers_slope_limit(settings);
  return options;
}

AlignAnswer by_continuous(const AlignmentPair& features, const AlignSettings& settings) {
  align::ContinuousWarpOptions options;
  options.slope_limit = continuous_slope_limit(settings);
  options.weights = settings.time.weights;
  auto warp = align::continuous_warp(features.input, features.output, settings.frame_rate, options);
  return {std::move(warp.correspondence), std::move(warp.objective), warp.space_warp.apply(features.input)};
}

AlignAnswer by_imw(const AlignmentPair& features, const AlignSettings& settings) {
  const align::IterativeMotionWarpingOptions options{
      counted(settings), {settings.smoothness, settings.smoothness}, settings.rounds};
  auto result = align::iterative_motion_warping(features.input, features.output, options);
  return {std::move(result.correspondence), std::move(result.objective), result.space_warp.apply(features.input),
          result.time_warp.is_exact};
}

AlignAnswer by_dtw(const AlignmentPair& features, const AlignSettings& settings, align::LocalConstraint constraint) {
  const auto result =
      align::dynamic_time_warping(features.input, features.output, constraint, {.weights = settings.time.weights});
  return {result.correspondence, {}, {}, result.is_exact};
}
AlignAnswer by_dtw1(const AlignmentPair& features, const AlignSettings& settings) {
  return by_dtw(features, settings, align::LocalConstraint::kTypeI);
}
AlignAnswer by_dtw3(const AlignmentPair& features, const AlignSettings& settings) {
  return by_dtw(features, settings, align::LocalConstraint::kTypeIII);
}

AlignAnswer by_time_warp(const AlignmentPair& features, const AlignSettings& settings) {
  const align::TimeWarp warp = align::time_warp(features.input, features.output, counted(settings));
  return {warp.correspondence(), {}, {}, warp.is_exact};
}

}  // namespace

const std::vector<AlignMethod>& align_methods() {
  constexpr double kCounted = 10.0;  // what smooths warps of counts: docs/correspondence.md
  static const std::vector<AlignMethod> methods{
      {"continuous", "continuous warp", "a smooth curve, as strut learn aligns", "imw", false, SignalSet::kAll, 0.0,
       false, continuous_slope_limit, by_continuous},
      {"imw", "IMW", "iterative motion warping", "dtw1", true, SignalSet::kPosture, kCounted, true, papers_slope_limit,
       by_imw},
      {"dtw1", "DTW, Type I", "dynamic time warping with Rabiner and Juang's local constraint of Type I, any slope",
       "imw", false, SignalSet::kPosture, kCounted, false, no_slope_limit, by_dtw1},
      {"dtw3", "DTW, Type III", "the same of Type III, slopes 1/2 to 2", "imw", false, SignalSet::kPosture, kCounted,
       false, slope_limit_two, by_dtw3},
      {"timewarp", "time warp alone", "the time-warp stage of imw", "imw", true, SignalSet::kPosture, kCounted, false,
       papers_slope_limit, by_time_warp},
  };
  return methods;
}

const AlignMethod& default_method(align::Ends ends) {
  const auto& all = align_methods();
  return *std::find_if(all.begin(), all.end(),
                       [&](const AlignMethod& method) { return ends == align::Ends::kFixed || method.opens_ends; });
}

const AlignMethod& compared_method(const AlignMethod& method, align::Ends ends) {
  const auto& all = align_methods();
  const auto usual = std::find_if(all.begin(), all.end(), [&](const AlignMethod& other) {
    return std::string(other.name) == method.compared_with;
  });
  if (usual->opens_ends || ends == align::Ends::kFixed) return *usual;
  return *std::find_if(all.rbegin(), all.rend(), [&](const AlignMethod& other) { return other.opens_ends; });
}

}  // namespace strut::cli
