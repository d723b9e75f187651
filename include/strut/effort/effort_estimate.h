// SPDX-License-Identifier: MIT
// Estimates of Effort from a movement's kinematics: something to start labelling from, and, once a person has labelled
// some, an estimate of how that person labels. Neither measures Laban's Effort, and neither is ever a person's label.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/effort/descriptors.h>
#include <strut/effort/effort.h>

namespace strut::effort {

/// From so many labels of a factor on, it is estimated as they say instead of by the starting formula.
inline constexpr int kFewestLabels = 20;

/// What is estimated of one movement. Space is never estimated.
struct EffortEstimate {
  EffortVector effort = EffortVector::Zero();  ///< each in [-1, 1]
  /// 0 ... 1. Of the starting formula a rule of thumb, lower in small groups and 0 for a fragment alone; once fitted,
  /// the share of the labels' deviation that is left out no more (1 - left-out error / deviation, at least 0).
  EffortVector confidence = EffortVector::Zero();
};

/// Described movements with a person's labels.
struct LabelledDescriptors {
  int group = 0;                                            ///< of like content, as in KinematicEstimator::fit's scales
  Eigen::VectorXd descriptors;                              ///< describe()'s
  EffortVector effort = EffortVector::Constant(kNotRated);  ///< kNotRated where a factor was left out
};

/// Everything that an estimator is, as plain numbers, to be kept in a file.
struct EstimatorNumbers {
  std::vector<DescriptorScale> groups;
  /// Of each factor: an offset, then a weight for each standardized descriptor and for tanh(0.6 z) of each
  /// (kNumPredictedFactors x 1 + 2 kNumDescriptors). Rows of factors that were not fitted are the starting formula's.
  Eigen::MatrixXd weights;
  EffortVector left_out_error = EffortVector::Constant(kNotRated);  ///< RMSE, by leaving one out; kNotRated: not fitted
  EffortVector label_deviation = EffortVector::Constant(kNotRated);  ///< of the labels; kNotRated: not fitted
  Eigen::Vector3i num_labels = Eigen::Vector3i::Zero();              ///< that each factor was fitted on, or would be
};

/// Estimates from descriptors standardized within groups of like content. Immutable; const calls are thread-safe.
class KinematicEstimator {
 public:
  /// The starting formula (effort.md): Time tanh(0.6 z) of the log acceleration, Flow of minus the hands' smoothness,
  /// Weight of the height lowered plus the peak deceleration with the speed regressed out. `groups`: the scale of each.
  explicit KinematicEstimator(std::vector<DescriptorScale> groups);
  /// As kept in a file. Throws InvalidArgument if sizes do not fit or a weight is not finite.
  explicit KinematicEstimator(EstimatorNumbers numbers);

  /// Fitted to a person's labels: every factor with kFewestLabels or more by ridge regression on standardized
  /// descriptors and their tanh(0.6 z), as stiff as leaves the least error when each label is left out; the others by
  /// the starting formula. Throws InvalidArgument for a group that is not there, a label outside [-1, 1], or
  /// descriptors of another width. Cost O(labels descriptors^2).
  static KinematicEstimator fit(std::vector<DescriptorScale> groups, const std::vector<LabelledDescriptors>& labels);

  /// Throws InvalidArgument if there is no such group or the descriptors' number does not fit. Cost O(descriptors).
  [[nodiscard]] EffortEstimate estimate(int group, const Eigen::Ref<const Eigen::VectorXd>& descriptors) const;

  [[nodiscard]] const EstimatorNumbers& numbers() const noexcept { return numbers_; }
  /// Whether a factor follows a person's labels.
  [[nodiscard]] bool is_fitted(Factor factor) const { return is_rated(numbers_.left_out_error[factor]); }

 private:
  EstimatorNumbers numbers_;
};

}  // namespace strut::effort
