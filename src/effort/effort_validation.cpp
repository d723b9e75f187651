// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/effort/effort_validation.h>

namespace strut::effort {
namespace {

constexpr double kNormalQuantile = 1.6448536269514722;  // a 90 % interval's half, in deviations

/// The part every fragment is in (fragments), from 0.
std::vector<int> parts_of(const std::vector<LabelledFragment>& fragments, ValidationSplit split,
                          const ValidationOptions& options, const std::vector<int>& performers) {
  std::vector<int> parts;
  std::map<int, int> seen, numbers;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const int group = fragments[i].group;
    if (split == ValidationSplit::kFragment) {
      parts.push_back((seen[group]++ + group) % options.num_folds);
      continue;
    }
    const int key = split == ValidationSplit::kAction ? group : performers[i];
    parts.push_back(numbers.try_emplace(key, static_cast<int>(numbers.size())).first->second);
  }
  return parts;
}

/// Sums over judged labels of one method.
struct Sums {
  Eigen::Array3d squares = Eigen::Array3d::Zero(), inside = Eigen::Array3d::Zero(), count = Eigen::Array3d::Zero();

  void add(const EffortPrediction& found, const EffortVector& label) {
    for (int d = 0; d < kNumPredictedFactors; ++d) {
      if (!is_rated(label[d]) || !is_rated(found.effort[d])) continue;
      const double error = found.effort[d] - label[d];
      squares[d] += error * error;
      count[d] += 1.0;
      // No deviation is NaN, which no error is below.
      inside[d] += std::abs(error) <= kNormalQuantile * found.deviation[d] ? 1.0 : 0.0;
    }
  }

  void add(const Sums& other) {
    squares += other.squares;
    inside += other.inside;
    count += other.count;
  }

  [[nodiscard]] EffortVector error() const {
    return (count > 0.0).select((squares / count.max(1.0)).sqrt(), kNotRated).matrix();
  }
};

double mean_of_judged(const EffortVector& errors) {
  double sum = 0.0;
  int count = 0;
  for (const double error : errors) {
    if (!is_rated(error)) continue;
    sum += error;
    ++count;
  }
  return count > 0 ? sum / count : kNotRated;
}

/// What one part's left-out blends gave: sums by group.
using PartSums = std::map<int, Sums>;

struct Split {
  std::vector<LabelledBlend> seen, judged;
};

Split split_at(const std::vector<LabelledBlend>& blends, const std::vector<int>& parts, int left_out) {
  Split result;
  for (const LabelledBlend& blend : blends) {
    const bool first = parts[static_cast<std::size_t>(blend.first)] == left_out;
    const bool second = parts[static_cast<std::size_t>(blend.second)] == left_out;
    if (first && second) result.judged.push_back(blend);
    if (!first && !second) result.seen.push_back(blend);
  }
  return result;
}

PartSums judge(const std::vector<LabelledFragment>& fragments, const Split& split, const RegressionOptions& options) {
  PartSums sums;
  if (split.judged.empty()) return sums;
  const EffortRegression regression = fit_effort_regression(fragments, split.seen, options);
  for (const LabelledBlend& blend : split.judged) {
    const Eigen::VectorXd alpha = Eigen::VectorXd::Constant(1, blend.alpha);
    sums[fragments[static_cast<std::size_t>(blend.first)].group].add(
        regression.predict(blend.first, blend.second, alpha).front(), blend.effort);
  }
  return sums;
}

bool has_intervals(RegressionMethod method) {
  return method == RegressionMethod::kLinearLabels || method == RegressionMethod::kLinearPlusResidual;
}

MethodScore score_of(RegressionMethod method, const std::vector<PartSums>& parts, int num_groups) {
  MethodScore score;
  score.method = method;
  score.group_error = Eigen::VectorXd::Constant(num_groups, kNotRated);
  PartSums by_group;
  Sums all;
  for (const PartSums& part : parts) {
    for (const auto& [group, sums] : part) {
      by_group[group].add(sums);
      all.add(sums);
    }
  }
  for (const auto& [group, sums] : by_group) score.group_error[group] = mean_of_judged(sums.error());
  score.error = all.error();
  score.mean_error = mean_of_judged(score.error);
  if (has_intervals(method)) {
    score.coverage = (all.count > 0.0).select(all.inside / all.count.max(1.0), kNotRated).matrix();
  }
  return score;
}

void check(const std::vector<LabelledFragment>& fragments, const std::vector<LabelledBlend>& blends,
           ValidationSplit split, const ValidationOptions& options, const std::vector<int>& performers) {
  if (options.num_folds < 2) throw InvalidArgument("num_folds", "at least 2", std::to_string(options.num_folds));
  if (split == ValidationSplit::kPerformer && performers.size() != fragments.size()) {
    throw InvalidArgument("performers", std::to_string(fragments.size()) + " numbers, one per fragment",
                          std::to_string(performers.size()));
  }
  for (const LabelledFragment& fragment : fragments) {
    if (fragment.group < 0) throw InvalidArgument("group", "a number from 0", std::to_string(fragment.group));
  }
  // Everything else is checked where all is learnt from at once, by a method that costs next to nothing.
  RegressionOptions nearest = options.regression;
  nearest.method = RegressionMethod::kNearestEnd;
  fit_effort_regression(fragments, blends, nearest);
}

}  // namespace

const MethodScore* ValidationResult::find(RegressionMethod method) const {
  const auto found =
      std::find_if(methods.begin(), methods.end(), [&](const MethodScore& score) { return score.method == method; });
  return found == methods.end() ? nullptr : &*found;
}

const MethodScore* ValidationResult::best_baseline() const {
  const MethodScore* best = nullptr;
  for (const RegressionMethod method : {RegressionMethod::kLinearLabels, RegressionMethod::kNearestEnd}) {
    const MethodScore* score = find(method);
    if (score == nullptr || !is_rated(score->mean_error)) continue;
    if (best == nullptr || score->mean_error < best->mean_error) best = score;
  }
  return best;
}

ValidationResult cross_validate(const std::vector<LabelledFragment>& fragments,
                                const std::vector<LabelledBlend>& blends, ValidationSplit split,
                                const ValidationOptions& options, const std::vector<int>& performers) {
  check(fragments, blends, split, options, performers);
  const std::vector<int> part = parts_of(fragments, split, options, performers);
  ValidationResult result;
  result.split = split;
  result.num_parts = *std::max_element(part.begin(), part.end()) + 1;
  for (const LabelledBlend& blend : blends) {
    const bool straddles = part[static_cast<std::size_t>(blend.first)] != part[static_cast<std::size_t>(blend.second)];
    if (straddles) ++result.num_straddling;
    for (int d = 0; d < kNumPredictedFactors && !straddles && result.num_parts > 1; ++d) {
      const bool ends_rated = is_rated(fragments[static_cast<std::size_t>(blend.first)].effort[d]) &&
                              is_rated(fragments[static_cast<std::size_t>(blend.second)].effort[d]);
      if (is_rated(blend.effort[d]) && ends_rated) ++result.num_judged[d];
    }
  }
  int num_groups = 0;
  for (const LabelledFragment& fragment : fragments) num_groups = std::max(num_groups, fragment.group + 1);
  const std::size_t num_methods = options.methods.size();
  const auto num_parts = static_cast<std::size_t>(result.num_parts > 1 ? result.num_parts : 0);
  std::vector<std::vector<PartSums>> sums(num_methods, std::vector<PartSums>(num_parts));
  tbb::parallel_for(std::size_t{0}, num_methods * num_parts, [&](std::size_t task) {
    const std::size_t m = task % num_methods, p = task / num_methods;
    RegressionOptions fitted = options.regression;
    fitted.method = options.methods[m];
    sums[m][p] = judge(fragments, split_at(blends, part, static_cast<int>(p)), fitted);
  });
  for (std::size_t m = 0; m < num_methods; ++m) {
    result.methods.push_back(score_of(options.methods[m], sums[m], num_groups));
  }
  return result;
}

}  // namespace strut::effort
