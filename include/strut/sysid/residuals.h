// SPDX-License-Identifier: MIT
// Whether what a system leaves of the outputs is noise: its correlation with itself and with the inputs.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::sysid {

/// Correlations of residuals, lag by lag, beside what independence would let chance do.
struct ResidualTests {
  FrameMatrix autocorrelation;         ///< of each output's residual, at lags 1 .. num_lags (lags x outputs)
  double autocorrelation_bound = 0.0;  ///< white noise stays within +- this in 99 of 100 lags
  Eigen::VectorXd ljung_box;           ///< Ljung and Box's statistic over all lags (outputs)
  Eigen::VectorXd whiteness;           ///< probability of one as large from white noise, 0 to 1 (outputs)
  Eigen::MatrixXd cross_correlation;   ///< with each input at that lag, 0 .. num_lags, of the largest modulus, input
                                       ///< first (outputs x inputs)
  Eigen::MatrixXd cross_bound;         ///< residuals unrelated to the input stay within +- this in 99 of 100 lags

  [[nodiscard]] int num_lags() const noexcept { return static_cast<int>(autocorrelation.rows()); }
  /// Outputs and lags whose autocorrelation is beyond its bound; about one in a hundred is expected.
  [[nodiscard]] int num_beyond() const;
};

/// Tests residuals for whiteness (Ljung and Box 1978) and for what the inputs would still explain (Ljung 1999, section
/// 16.6, whose bound allows for colour in both). Means are taken off first; sums run over all clips, never across a
/// border. Prediction's residuals should be white; simulation's need not be, but neither should follow the inputs.
///
/// `residuals` (frames x outputs) and `inputs` (frames x inputs), one of each per clip; `num_lags` 1 or more, of which
/// those shorter than the longest clip are used. Residuals or inputs that are zero correlate with nothing. Throws
/// InvalidArgument if there is no clip, shapes do not agree or a number is not finite.
/// Cost frames x lags x outputs x inputs.
ResidualTests test_residuals(const std::vector<FrameMatrix>& residuals, const std::vector<FrameMatrix>& inputs,
                             int num_lags = 25);

/// The probability that a chi-squared variable of `degrees` (positive) is above `value` (0 or more).
double chi_squared_tail(double value, double degrees);

}  // namespace strut::sysid
