// SPDX-License-Identifier: MIT
// The states of a system as the data show them: estimated from past and future of each Hankel column, for the
// textbook's regression of B and D and for what is left over, the noise.
#pragma once

#include <Eigen/Core>

#include <strut/sysid/n4sid.h>
#include <strut/sysid/riccati.h>

namespace strut::sysid {

/// Estimated states and the signals beside them. A row is not a frame but a row of the Hankel data's triangular factor:
/// sums of products over rows are those over all `num_columns` frames, which is all that least squares and covariances
/// need.
struct StateEstimates {
  Eigen::MatrixXd state;       ///< x[t] (rows x states)
  Eigen::MatrixXd next_state;  ///< x[t+1] (rows x states)
  Eigen::MatrixXd input;       ///< u[t] (rows x inputs)
  Eigen::MatrixXd output;      ///< y[t] (rows x outputs)
  long num_columns = 0;        ///< frames the rows stand for
};

/// States from the oblique projection of future outputs along future inputs onto the past, x[t+1] from the same shifted
/// by a frame (Van Overschee and De Moor 1996, section 4.3), in the coordinates of the given A and C, whose
/// observability matrix takes the place of the singular vectors.
///
/// `a` (states x states), `c` (outputs x states). Throws InvalidArgument if they do not fit each other or the factor,
/// or the factor has fewer than 2 block rows or fewer outputs times block rows less one than states. Cost width^3.
StateEstimates estimate_states(const HankelFactor& factor, const Eigen::MatrixXd& a, const Eigen::MatrixXd& c);

/// B and D by least squares on estimated states, A and C given: the textbook's way. On short or nearly periodic clips
/// it is much worse than fit_input_matrices. A direction in which the inputs do not move gets zeros.
LtiSystem input_matrices_from_states(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                     const StateEstimates& estimates);

/// Covariances of what the system leaves of the estimated states and outputs. Same coordinates as the estimates';
/// throws InvalidArgument if the widths do not agree.
NoiseCovariances noise_covariances(const LtiSystem& system, const StateEstimates& estimates);

}  // namespace strut::sysid
