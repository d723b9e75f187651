// SPDX-License-Identifier: MIT
#include "align_methods.h"

#include <algorithm>
#include <utility>

#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>
#include <strut/core/error.h>

namespace strut::cli {
namespace {

using representation::AlignmentPair;

double slope_limit_given(const AlignSettings& settings) {
  return settings.slope_limit;
}
double no_slope_limit(const AlignSettings&) {
  return 0.0;
}
double slope_limit_two(const AlignSettings&) {
  return 2.0;
}

AlignAnswer by_imw(const AlignmentPair& features, const AlignSettings& settings) {
  align::IterativeMotionWarpingOptions options;
  options.slope_limit = settings.slope_limit;
  options.space = {settings.smoothness, settings.smoothness};
  options.max_rounds = settings.rounds;
  options.weights = settings.weights;
  auto result = align::iterative_motion_warping(features.input, features.output, options);
  return {std::move(result.correspondence), std::move(result.objective), result.space_warp.apply(features.input)};
}

AlignAnswer by_dtw(const AlignmentPair& features, const AlignSettings& settings, align::LocalConstraint constraint) {
  return {align::dynamic_time_warping(features.input, features.output, constraint, settings.weights).correspondence};
}
AlignAnswer by_dtw1(const AlignmentPair& features, const AlignSettings& settings) {
  return by_dtw(features, settings, align::LocalConstraint::kTypeI);
}
AlignAnswer by_dtw3(const AlignmentPair& features, const AlignSettings& settings) {
  return by_dtw(features, settings, align::LocalConstraint::kTypeIII);
}

AlignAnswer by_time_warp(const AlignmentPair& features, const AlignSettings& settings) {
  const auto counts = align::time_warp(features.input, features.output, settings.slope_limit, settings.weights);
  return {align::from_repetitions(counts, settings.slope_limit)};
}

}  // namespace

const std::vector<AlignMethod>& align_methods() {
  static const std::vector<AlignMethod> methods{
      {"imw", "IMW", "iterative motion warping", "dtw1", slope_limit_given, by_imw},
      {"dtw1", "DTW, Type I", "dynamic time warping with Rabiner and Juang's local constraint of Type I, any slope",
       "imw", no_slope_limit, by_dtw1},
      {"dtw3", "DTW, Type III", "the same of Type III, slopes 1/2 to 2", "imw", slope_limit_two, by_dtw3},
      {"timewarp", "the time warp alone", "the time-warp stage of imw", "imw", slope_limit_given, by_time_warp},
  };
  return methods;
}

const AlignMethod& align_method(const std::string& name) {
  const auto& all = align_methods();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const AlignMethod& method) { return method.name == name; });
  if (found == all.end()) throw InvalidArgument("name", "a method", "'" + name + "'");
  return *found;
}

}  // namespace strut::cli
