// SPDX-License-Identifier: MIT
// Private to identification: a change of input and output coordinates in which the numbers are of size one and no input
// is a combination of others, and the way back.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid::detail {

/// Inputs are whitened (about zero; directions that do not move are dropped), outputs divided by their root mean
/// square.
class Balance {
 public:
  /// `experiments` must have passed check_experiments.
  explicit Balance(const std::vector<Experiment>& experiments);

  /// How many independent directions the inputs move in; may be 0.
  [[nodiscard]] int num_directions() const noexcept { return static_cast<int>(input_map_.rows()); }
  /// The clips in the new coordinates; needs num_directions() > 0.
  [[nodiscard]] std::vector<Experiment> apply(const std::vector<Experiment>& experiments) const;
  /// A system of the old coordinates in the new ones: the same response to every input that moves as the clips' do.
  [[nodiscard]] LtiSystem apply(const LtiSystem& system) const;
  /// What the outputs were divided by (outputs).
  [[nodiscard]] const Eigen::VectorXd& output_scale() const noexcept { return output_scale_; }
  /// A system of the new coordinates in the old ones.
  [[nodiscard]] LtiSystem undo(const LtiSystem& system) const;

 private:
  Eigen::MatrixXd input_map_;     // (directions x inputs)
  Eigen::MatrixXd input_unmap_;   // (inputs x directions), its right inverse
  Eigen::VectorXd output_scale_;  // (outputs)
};

}  // namespace strut::sysid::detail
