// SPDX-License-Identifier: MIT
// The stationary Kalman filter of a noisy linear system: a discrete algebraic Riccati equation, solved by doubling.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace strut::sysid {

/// Second moments of the noise w on the state and v on the output of  x' = A x + B u + w,  y = C x + D u + v.
struct NoiseCovariances {
  Eigen::MatrixXd state;   ///< Q = E[w w'] (states x states)
  Eigen::MatrixXd cross;   ///< S = E[w v'] (states x outputs)
  Eigen::MatrixXd output;  ///< R = E[v v'] (outputs x outputs)
};

/// The filter  x' = A x + B u + K e,  e = y - C x - D u.
struct KalmanFilter {
  Eigen::MatrixXd gain;        ///< K (states x outputs); A - K C is stable
  Eigen::MatrixXd error;       ///< P, covariance of the state's estimate (states x states)
  Eigen::MatrixXd innovation;  ///< C P C' + R, covariance of e (outputs x outputs)
};

/// The filter of the stabilizing solution of  P = A P A' + Q - (A P C' + S)(C P C' + R)^-1 (A P C' + S)',  by the
/// structure-preserving doubling algorithm (Chu, Fan, Lin, Wang 2004, "Structure-preserving algorithms for periodic
/// discrete-time algebraic Riccati equations"), which converges quadratically.
///
/// `a` (states x states), `c` (outputs x states), covariances symmetric. Nothing is returned if there is no such
/// solution within rounding: R not positive definite, or a mode on the unit circle that noise does not reach. Throws
/// InvalidArgument if the shapes do not agree or a number is not finite. Cost a few dozen times states^3.
std::optional<KalmanFilter> stationary_kalman_filter(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                                     const NoiseCovariances& noise);

}  // namespace strut::sysid
