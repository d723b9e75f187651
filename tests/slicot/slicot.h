// SPDX-License-Identifier: MIT
// SLICOT's subspace identification, called through its Fortran interface, to compare with. SLICOT is GPL in Debian:
// these tests link it, nothing that is installed does.
#pragma once

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::test {

/// IB01BD's METH.
enum class SlicotMethod : char { kMoesp = 'M', kN4sid = 'N', kCombined = 'C' };

struct SlicotResult {
  sysid::LtiSystem system;
  Eigen::MatrixXd gain;  ///< Kalman gain (states x outputs)
};

/// The order with the largest logarithmic gap of the singular values, as IB01AD estimates it from one clip.
int slicot_order(SlicotMethod method, const sysid::Experiment& clip, int block_rows);

/// IB01AD and IB01BD on one clip without lead-in: A, B, C, D and the Kalman gain of `order` states, below `block_rows`.
/// Throws std::runtime_error if SLICOT refuses.
SlicotResult slicot_identify(SlicotMethod method, const sysid::Experiment& clip, int block_rows, int order);

}  // namespace strut::test
