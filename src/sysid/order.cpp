// SPDX-License-Identifier: MIT
// Folds of groups of clips, rounds of leaving them out, and the smallest order that fits left-out clips nearly as well
// as the best.
#include <algorithm>
#include <map>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/order.h>

namespace strut::sysid {

std::vector<int> assign_folds(const std::vector<int>& groups, const std::vector<int>& weights, int num_folds) {
  if (groups.size() != weights.size()) {
    throw InvalidArgument("groups", std::to_string(weights.size()) + " elements", std::to_string(groups.size()));
  }
  if (num_folds < 1) throw InvalidArgument("num_folds", "1 or more", std::to_string(num_folds));
  std::map<int, long> totals;
  for (std::size_t k = 0; k < groups.size(); ++k) totals[groups[k]] += weights[k];
  std::vector<std::pair<int, long>> heaviest_first(totals.begin(), totals.end());
  std::stable_sort(heaviest_first.begin(), heaviest_first.end(),
                   [](const auto& one, const auto& other) { return one.second > other.second; });
  std::vector<long> fold_weight(std::max<std::size_t>(1, std::min<std::size_t>(totals.size(), num_folds)), 0);
  std::map<int, int> fold_of;
  for (const auto& [group, weight] : heaviest_first) {
    const auto lightest = std::min_element(fold_weight.begin(), fold_weight.end());
    fold_of[group] = static_cast<int>(lightest - fold_weight.begin());
    *lightest += weight;
  }
  std::vector<int> folds;
  for (const int group : groups) folds.push_back(fold_of.at(group));
  return folds;
}

int smallest_good_order(const std::vector<double>& fits, double tolerance) {
  if (fits.empty()) throw InvalidArgument("fits", "at least one order", "none");
  const double best = *std::max_element(fits.begin(), fits.end());
  const auto good = std::find_if(fits.begin(), fits.end(), [&](double fit) { return fit >= best - tolerance; });
  return static_cast<int>(good - fits.begin());
}

int largest_gap(const Eigen::VectorXd& singular_values, int max_order) {
  constexpr double kRounding = 1e-12;
  if (max_order < 0) throw InvalidArgument("max_order", "0 or more", std::to_string(max_order));
  if (singular_values.size() == 0 || !(singular_values[0] > 0.0)) return 0;
  const Eigen::VectorXd values = singular_values.cwiseMax(kRounding * singular_values[0]);
  int order = 0;
  double largest = 0.0;
  for (int n = 1; n <= max_order && n < values.size(); ++n) {
    const double ratio = values[n - 1] / values[n];
    if (ratio > largest) order = n;
    largest = std::max(largest, ratio);
  }
  return order;
}

namespace {

int count(const std::vector<int>& folds) {
  return folds.empty() ? 0 : *std::max_element(folds.begin(), folds.end()) + 1;
}

/// The output fold that is tested along with each input fold, or -1: the two that share most weight first, so that as
/// many clips as can be are tested.
std::vector<int> match_folds(const std::vector<int>& inputs, const std::vector<int>& outputs,
                             const std::vector<int>& weights) {
  std::map<std::pair<int, int>, long> shared;
  for (std::size_t k = 0; k < inputs.size(); ++k) shared[{inputs[k], outputs[k]}] += weights[k];
  std::vector<std::pair<std::pair<int, int>, long>> heaviest_first(shared.begin(), shared.end());
  std::stable_sort(heaviest_first.begin(), heaviest_first.end(),
                   [](const auto& one, const auto& other) { return one.second > other.second; });
  std::vector<int> partner(static_cast<std::size_t>(count(inputs)), -1);
  for (const auto& [folds, weight] : heaviest_first) {
    const bool is_taken = std::find(partner.begin(), partner.end(), folds.second) != partner.end();
    if (partner[folds.first] == -1 && !is_taken) partner[folds.first] = folds.second;
  }
  return partner;
}

}  // namespace

LeaveOut leave_out_pairs(const std::vector<int>& input_groups, const std::vector<int>& output_groups,
                         const std::vector<int>& weights, int num_folds) {
  const std::vector<int> inputs = assign_folds(input_groups, weights, num_folds);
  const std::vector<int> outputs = assign_folds(output_groups, weights, num_folds);
  const std::vector<int> partner = match_folds(inputs, outputs, weights);
  LeaveOut result;
  for (int fold = 0; fold < count(inputs); ++fold) {
    if (partner[fold] == -1) continue;
    std::vector<Role>& roles = result.rounds.emplace_back();
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      const int matches = (inputs[k] == fold ? 1 : 0) + (outputs[k] == partner[fold] ? 1 : 0);
      roles.push_back(matches == 2 ? Role::kTest : matches == 0 ? Role::kLearn : Role::kUnused);
    }
  }
  return result;
}

LeaveOut leave_out_groups(const std::vector<int>& groups, const std::vector<int>& weights, int num_folds) {
  return leave_out_pairs(groups, groups, weights, num_folds);
}

}  // namespace strut::sysid
