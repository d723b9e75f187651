// SPDX-License-Identifier: MIT
// Private to regularized identification: least squares on impulse responses that vary in a prior's directions only.
#pragma once

#include "sysid/lag_sums.h"

#include <Eigen/Core>

namespace strut::sysid::detail {

/// Sums over clips as LagSums holds them, with the taps of every input replaced by coefficients of the prior's
/// directions: input by input, directions within.
struct ProjectedSums {
  Eigen::MatrixXd uu;  ///< (inputs x directions) squared; the lower triangle counts, what is above is undefined
  Eigen::MatrixXd uy;  ///< (inputs x directions) x outputs
  Eigen::VectorXd yy;  ///< outputs
  double frames = 0.0;
};

/// `factor` (taps x directions) turns coefficients into taps. Cost (inputs x taps)^2 x directions.
ProjectedSums project(const LagSums& sums, const Eigen::MatrixXd& factor);

/// What is left of `sums` without those of some of its clips.
ProjectedSums without(ProjectedSums sums, const ProjectedSums& some);

/// The coefficients (inputs x directions) x outputs that fit best, each of variance `deviations`^2 times the noise's.
/// Cost (inputs x directions)^3.
Eigen::MatrixXd solve(const ProjectedSums& sums, const Eigen::VectorXd& deviations);

/// The squared error of coefficients, per output. Cost (inputs x directions)^2 x outputs.
Eigen::VectorXd squared_errors(const ProjectedSums& sums, const Eigen::MatrixXd& coefficients);

/// Minus twice the logarithm of the probability of the outputs, up to a constant, each with the noise variance that
/// suits it best. Outputs that are zero do not count. Cost (inputs x directions)^3.
double negative_log_likelihood(const ProjectedSums& sums, const Eigen::VectorXd& deviations);

}  // namespace strut::sysid::detail
