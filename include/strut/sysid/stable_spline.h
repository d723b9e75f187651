// SPDX-License-Identifier: MIT
// Priors for impulse responses: what is known of a stable system before any data are seen. Its response decays, and
// neighbouring taps are alike.
#pragma once

#include <Eigen/Core>

namespace strut::sysid {

/// Covariance functions of an impulse response g (Chen, Ohlsson and Ljung 2012, "On the estimation of transfer
/// functions, regularizations and Gaussian processes - revisited"; Pillonetto and De Nicolao 2010 for SS).
enum class Kernel {
  kTc,  ///< tuned/correlated: decay^max(i, j); a first-order stable spline
  kDc,  ///< diagonal/correlated: decay^((i + j) / 2) correlation^|i - j|
  kSs,  ///< second-order stable spline: smoother responses
};

/// The shape of a prior, up to its scale.
struct KernelShape {
  Kernel kernel = Kernel::kTc;
  double decay = 0.9;        ///< of the variance from one tap to the next, in (0, 1) [per frame]
  double correlation = 0.9;  ///< of neighbouring taps, in [-1, 1]; kDc only
};

/// The covariance of the taps 0 .. taps-1, scaled so that tap k has variance decay^k: (taps x taps), symmetric,
/// positive semidefinite up to rounding. Throws InvalidArgument unless there is a tap and the shape is in range. Cost
/// taps^2.
Eigen::MatrixXd kernel_covariance(const KernelShape& shape, int taps);

/// The directions in which the prior varies, most first, scaled by their deviation: F (taps x directions) with F F' the
/// covariance, but for directions whose variance is less than `least_variance` (0 to 1) of the largest, which are left
/// out: there is always one. Throws as kernel_covariance, and InvalidArgument if `least_variance` is out of range. Cost
/// taps^3.
Eigen::MatrixXd kernel_factor(const KernelShape& shape, int taps, double least_variance = 1e-3);

}  // namespace strut::sysid
