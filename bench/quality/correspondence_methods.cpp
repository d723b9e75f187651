// SPDX-License-Identifier: MIT
#include "correspondence_methods.h"

#include <algorithm>
#include <cmath>

#include <strut/align/continuous_warp.h>
#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>

namespace strut::study {
namespace {

constexpr double kErrorRate = 30.0;  // [frames/s] that errors count in
constexpr double kSmoothing = 0.1;   // [s]
constexpr double kPapersLimit = 2.0;

align::Correspondence continuous(const Method& method, const Signals& signals) {
  align::ContinuousWarpOptions options;
  options.slope_limit = method.slope_limit;
  if (method.slope_reach >= 0.0) options.slope_reach = method.slope_reach;
  if (method.space_reach >= 0.0) options.space_reach = method.space_reach;
  options.weights = signals.weights;
  return align::continuous_warp(signals.input, signals.output, signals.frame_rate, options).correspondence;
}

align::Correspondence iterative(const Signals& signals) {
  align::IterativeMotionWarpingOptions options;
  options.weights = signals.weights;
  return align::iterative_motion_warping(signals.input, signals.output, options).correspondence;
}

align::Correspondence time_warp(const Signals& signals) {
  align::TimeWarpOptions options;
  options.weights = signals.weights;
  return align::time_warp(signals.input, signals.output, options).correspondence();
}

align::Correspondence dtw(const Signals& signals, align::LocalConstraint constraint) {
  align::DynamicTimeWarpingOptions options;
  options.weights = signals.weights;
  return align::dynamic_time_warping(signals.input, signals.output, constraint, options).correspondence;
}

align::Correspondence as_found(const Method& method, const Signals& signals) {
  switch (method.solver) {
    case Solver::kIterative:
      return iterative(signals);
    case Solver::kTimeWarp:
      return time_warp(signals);
    case Solver::kDtw1:
      return dtw(signals, align::LocalConstraint::kTypeI);
    case Solver::kDtw3:
      return dtw(signals, align::LocalConstraint::kTypeIII);
    case Solver::kContinuous:
      return continuous(method, signals);
    case Solver::kUniform:
      break;
  }
  return {Eigen::VectorXd::Constant(
      signals.input.rows(), static_cast<double>(signals.output.rows()) / static_cast<double>(signals.input.rows()))};
}

}  // namespace

std::vector<Method> papers_methods(const representation::FeatureShares& features, const std::string& beside) {
  return {{"IMW" + beside, Solver::kIterative, features},
          {"time-warp stage alone" + beside, Solver::kTimeWarp, features},
          {"DTW, Type I" + beside, Solver::kDtw1, features},
          {"DTW, Type III" + beside, Solver::kDtw3, features}};
}

double slope_limit_of(const Method& method) {
  return method.solver == Solver::kContinuous ? method.slope_limit : kPapersLimit;
}

align::Correspondence solve(const Method& method, const Signals& signals) {
  align::Correspondence found = as_found(method, signals);
  if (!method.is_smoothed) return found;
  const double reach = kSmoothing * signals.frame_rate;
  return {align::smooth_differential_warp(found.differential_warp, reach * reach)};
}

void Figures::add_error(double error) {
  errors_.push_back(error);
}

void Figures::add_warp(const Eigen::VectorXd& warp, double frame_rate, double slope_limit) {
  const Eigen::Index lag = std::max<Eigen::Index>(1, std::lround(frame_rate / kErrorRate));
  const Eigen::Index count = std::max<Eigen::Index>(0, warp.size() - lag);
  squared_changes_ += (warp.tail(count) - warp.head(count)).squaredNorm();
  changes_ += static_cast<double>(count);
  at_limit_ += align::share_at_slope_limit(warp, slope_limit) * static_cast<double>(warp.size());
  frames_ += static_cast<double>(warp.size());
}

void Figures::add(const Figures& other) {
  errors_.insert(errors_.end(), other.errors_.begin(), other.errors_.end());
  squared_changes_ += other.squared_changes_;
  changes_ += other.changes_;
  at_limit_ += other.at_limit_;
  frames_ += other.frames_;
}

double Figures::mean() const {
  double sum = 0.0;
  for (const double error : errors_) sum += std::abs(error);
  return sum / static_cast<double>(errors_.size());
}

double Figures::bias() const {
  double sum = 0.0;
  for (const double error : errors_) sum += error;
  return sum / static_cast<double>(errors_.size());
}

double Figures::quantile(double share) const {
  if (errors_.empty()) return 0.0;
  std::vector<double> sorted;
  for (const double error : errors_) sorted.push_back(std::abs(error));
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

double Figures::roughness() const {
  return std::sqrt(squared_changes_ / changes_);
}

double Figures::share_at_limit() const {
  return at_limit_ / frames_;
}

}  // namespace strut::study
