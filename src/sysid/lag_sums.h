// SPDX-License-Identifier: MIT
// Sums of products of lagged signals over clips: all that least squares on finite impulse responses needs to know.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/sysid/experiment.h>

namespace strut::sysid::detail {

/// Normal equations of y[t] = sum over inputs i and lags a of g_i[a] u_i[t - a]. Coefficients stand input by input,
/// lags within. Sums of sets of clips add.
struct LagSums {
  Eigen::MatrixXd uu;  ///< (inputs x taps) squared
  Eigen::MatrixXd uy;  ///< (inputs x taps) x outputs
  Eigen::VectorXd yy;  ///< outputs
  Eigen::VectorXd y;   ///< outputs: plain sums, for the mean
  double frames = 0.0;

  LagSums(int num_inputs, int num_outputs, int taps);

  /// Adds the rows of clips after their lead-ins; before a clip's first row the input is zero. `taps` as constructed.
  /// Cost frames x inputs^2 x taps + clips x (inputs x taps)^2.
  void add(const std::vector<const Experiment*>& clips, int taps);
  LagSums& operator+=(const LagSums& other);

 private:
  void add_products(const Eigen::MatrixXd& lag_zero, const Eigen::MatrixXd& moved);
};

}  // namespace strut::sysid::detail
