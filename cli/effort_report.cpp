// SPDX-License-Identifier: MIT
#include "effort_report.h"

#include <algorithm>

#include <fmt/format.h>

namespace strut::cli {
namespace {

using effort::MethodScore;
using effort::RegressionMethod;
using effort::ValidationResult;
using effort::ValidationSplit;

const char* name_of(RegressionMethod method) {
  return effort::kRegressionMethodNames[static_cast<std::size_t>(method)];
}

std::string number(double value) {
  return effort::is_rated(value) ? fmt::format("{:.3f}", value) : "-";
}

std::string percent(double share) {
  return effort::is_rated(share) ? fmt::format("{:.0f} %", 100.0 * share) : std::string("-");
}

std::string against(const MethodScore& score, const MethodScore* baseline) {
  if (baseline == nullptr || !effort::is_rated(score.mean_error)) return "";
  if (&score == baseline) return "  best baseline";
  return fmt::format("  {:+.0f} % of {}", 100.0 * (score.mean_error / baseline->mean_error - 1.0),
                     name_of(baseline->method));
}

std::string method_table(const ValidationResult& result) {
  std::string text = fmt::format("  {:<10}{:>8}{:>8}{:>8}{:>8}   in 90 % intervals (flow, weight, time)\n", "method",
                                 "flow", "weight", "time", "mean");
  const MethodScore* baseline = result.best_baseline();
  for (const MethodScore& score : result.methods) {
    text += fmt::format("  {:<10}{:>8}{:>8}{:>8}{:>8}   {:>5}{:>7}{:>7}{}\n", name_of(score.method),
                        number(score.error[0]), number(score.error[1]), number(score.error[2]),
                        number(score.mean_error), percent(score.coverage[0]), percent(score.coverage[1]),
                        percent(score.coverage[2]), against(score, baseline));
  }
  return text;
}

bool is_judged(const ValidationResult& result, Eigen::Index group) {
  return std::any_of(result.methods.begin(), result.methods.end(),
                     [&](const MethodScore& score) { return effort::is_rated(score.group_error[group]); });
}

/// Groups of which a blend was judged, at most kMostShown.
std::string group_table(const ValidationResult& result, const std::vector<std::string>& names) {
  constexpr int kMostShown = 20;
  std::string text = fmt::format("  {:<24}", "action");
  for (const MethodScore& score : result.methods) text += fmt::format("{:>10}", name_of(score.method));
  text += '\n';
  int judged = 0;
  for (Eigen::Index group = 0; group < result.methods.front().group_error.size(); ++group) {
    if (!is_judged(result, group) || ++judged > kMostShown) continue;
    const auto named = static_cast<std::size_t>(group) < names.size();
    text += fmt::format("  {:<24}", named ? names[static_cast<std::size_t>(group)] : fmt::format("group {}", group));
    for (const MethodScore& score : result.methods) text += fmt::format("{:>10}", number(score.group_error[group]));
    text += '\n';
  }
  if (judged > kMostShown) text += fmt::format("  and {} more\n", judged - kMostShown);
  return text;
}

std::string split_report(const ValidationResult& result, const std::vector<std::string>& names) {
  const char* what = effort::kValidationSplitNames[static_cast<std::size_t>(result.split)];
  if (result.num_judged.maxCoeff() == 0) {
    return fmt::format("{}s left out: no labelled blend lies inside one part of {}; nothing can be judged\n", what,
                       result.num_parts);
  }
  std::string text = fmt::format("{}s left out, {} parts: error (RMSE) of {} labelled blends with both ends left out",
                                 what, result.num_parts, result.num_judged.maxCoeff());
  if (result.num_straddling > 0) {
    text += fmt::format("; {} with one end in two parts each are not judged", result.num_straddling);
  }
  text += '\n' + method_table(result);
  if (result.split == ValidationSplit::kAction) text += group_table(result, names);
  return text;
}

}  // namespace

std::string validation_report(const std::vector<ValidationResult>& results,
                              const std::vector<std::string>& group_names) {
  std::string text;
  for (const ValidationResult& result : results) {
    if (!result.methods.empty()) text += split_report(result, group_names);
  }
  return text;
}

}  // namespace strut::cli
