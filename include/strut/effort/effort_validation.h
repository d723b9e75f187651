// SPDX-License-Identifier: MIT
// How well labels of blends are predicted that were not learnt from: cross-validation by fragment, by action and by
// performer, for every method beside its baselines. A random split would flatter: blends of one pair are much alike.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/effort/effort_regression.h>

namespace strut::effort {

/// What is left out at a time.
enum class ValidationSplit {
  kFragment,   ///< fragments, in ValidationOptions::num_folds parts of every group
  kAction,     ///< a group of like content
  kPerformer,  ///< all fragments of one performer
};
inline constexpr int kNumValidationSplits = 3;
/// "fragment", "action", "performer", in the order of ValidationSplit.
inline constexpr std::array<const char*, kNumValidationSplits> kValidationSplitNames = {"fragment", "action",
                                                                                        "performer"};

/// Which methods are tried, and how.
struct ValidationOptions {
  std::vector<RegressionMethod> methods = {RegressionMethod::kLinearLabels, RegressionMethod::kNearestEnd,
                                           RegressionMethod::kSupportVector, RegressionMethod::kLinearPlusResidual};
  RegressionOptions regression;  ///< but for the method
  int num_folds = 4;             ///< of fragments, >= 2
};

/// Predictions of one method against the labels of left-out blends.
struct MethodScore {
  RegressionMethod method = RegressionMethod::kLinearLabels;
  EffortVector error = EffortVector::Constant(kNotRated);  ///< RMSE per factor; kNotRated: nothing to judge
  EffortVector coverage =
      EffortVector::Constant(kNotRated);  ///< share inside the 90 % intervals; kNotRated: no intervals
  double mean_error = kNotRated;          ///< mean of the factors that could be judged
  Eigen::VectorXd group_error;            ///< mean error of every group's blends; kNotRated: none judged (groups)
};

/// One split's results.
struct ValidationResult {
  ValidationSplit split = ValidationSplit::kFragment;
  int num_parts = 0;                                     ///< left out in turn
  Eigen::Vector3i num_judged = Eigen::Vector3i::Zero();  ///< labels that were predicted, per factor
  int num_straddling = 0;            ///< blends with one end left out and one not, counted once a blend
  std::vector<MethodScore> methods;  ///< in the order of ValidationOptions::methods

  /// The best of linear labels and the nearest end, by mean error; null if neither was tried or nothing was judged.
  [[nodiscard]] const MethodScore* best_baseline() const;
  [[nodiscard]] const MethodScore* find(RegressionMethod method) const;
};

/// Leaves every part out once, learns from the blends with no fragment in it and predicts those with both fragments in
/// it. A blend with one end in it and one outside is neither learnt from nor judged while that part is left out, for
/// half of it has been seen; num_straddling says how many blends that befell (and so could never be judged). Labels of
/// the left-out fragments themselves are known to f, as Eq. 1 has it.
///
/// `performers`: a number per fragment, for kPerformer only. With fewer than two parts, or no blend inside one,
/// nothing is judged. Folds run in parallel; the result does not depend on how many threads.
/// Throws InvalidArgument as fit_effort_regression does, or if an option is out of range or `performers` does not fit.
/// Cost: parts x methods fits.
ValidationResult cross_validate(const std::vector<LabelledFragment>& fragments,
                                const std::vector<LabelledBlend>& blends, ValidationSplit split,
                                const ValidationOptions& options = {}, const std::vector<int>& performers = {});

}  // namespace strut::effort
