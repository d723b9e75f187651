// SPDX-License-Identifier: MIT
#include "align_methods.h"

#include <algorithm>
#include <string>
#include <utility>

#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>

namespace strut::cli {
namespace {

using representation::AlignmentPair;

double slope_limit_given(const AlignSettings& settings) {
  return settings.time.slope_limit;
}
double no_slope_limit(const AlignSettings&) {
  return 0.0;
}
double slope_limit_two(const AlignSettings&) {
  return 2.0;
}

AlignAnswer by_imw(const AlignmentPair& features, const AlignSettings& settings) {
  const align::IterativeMotionWarpingOptions options{
      settings.time, {settings.smoothness, settings.smoothness}, settings.rounds};
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
  const align::TimeWarp warp = align::time_warp(features.input, features.output, settings.time);
  return {warp.correspondence(), {}, {}, warp.is_exact};
}

}  // namespace

const std::vector<AlignMethod>& align_methods() {
  static const std::vector<AlignMethod> methods{
      {"imw", "IMW", "iterative motion warping", "dtw1", true, slope_limit_given, by_imw},
      {"dtw1", "DTW, Type I", "dynamic time warping with Rabiner and Juang's local constraint of Type I, any slope",
       "imw", false, no_slope_limit, by_dtw1},
      {"dtw3", "DTW, Type III", "the same of Type III, slopes 1/2 to 2", "imw", false, slope_limit_two, by_dtw3},
      {"timewarp", "time warp alone", "the time-warp stage of imw", "imw", true, slope_limit_given, by_time_warp},
  };
  return methods;
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
