// SPDX-License-Identifier: MIT
// Sums of products of lagged signals over clips: all that least squares on finite impulse responses needs to know.
#pragma once

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

  /// Adds the rows of a clip after its lead-in; before its first row the input is zero. `taps` as constructed.
  /// Cost frames x inputs^2 x taps + (inputs x taps)^2.
  void add(const Experiment& experiment, int taps);
  LagSums& operator+=(const LagSums& other);

 private:
  void add_products(const Eigen::MatrixXd& lagged, Eigen::Index taps);
};

}  // namespace strut::sysid::detail
