// SPDX-License-Identifier: MIT
// Private to refinement: the simulation error of a system on clips and its derivatives by all of A, B, C and D.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid::detail {

/// Where the elements of A, B (both column by column), C and D (both row by row) stand among a system's parameters.
struct ParameterLayout {
  Eigen::Index n, m, l;  ///< states, inputs, outputs
  [[nodiscard]] Eigen::Index b() const { return n * n; }
  [[nodiscard]] Eigen::Index c() const { return n * (n + m); }
  [[nodiscard]] Eigen::Index d() const { return n * (n + m + l); }
  [[nodiscard]] Eigen::Index count() const { return (n + l) * (n + m); }
};

ParameterLayout layout_of(const LtiSystem& system);
Eigen::VectorXd parameters_of(const LtiSystem& system);
LtiSystem system_of(const ParameterLayout& layout, const Eigen::VectorXd& parameters);

/// The sum over clips, frames and outputs of (weight (y - simulated))^2.
class OutputError {
 public:
  /// Keeps a reference to the clips. `weights` (outputs), positive.
  OutputError(const std::vector<Experiment>& clips, Eigen::VectorXd weights, bool from_rest);

  /// The state each clip is simulated from: fitted, or none (rest).
  [[nodiscard]] std::vector<Eigen::VectorXd> initial_states(const LtiSystem& system) const;
  [[nodiscard]] double value(const LtiSystem& system, const std::vector<Eigen::VectorXd>& initial_states) const;

  /// Gauss-Newton's quadratic model of the error about a system, initial states eliminated.
  struct Derivatives {
    Eigen::MatrixXd gram;   ///< J' J (parameters x parameters)
    Eigen::VectorXd right;  ///< J' (weighted error): the direction of descent (parameters)
  };
  [[nodiscard]] Derivatives derivatives(const LtiSystem& system,
                                        const std::vector<Eigen::VectorXd>& initial_states) const;

 private:
  const std::vector<Experiment>& clips_;
  Eigen::VectorXd weights_;
  bool from_rest_;
};

}  // namespace strut::sysid::detail
