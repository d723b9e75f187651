// SPDX-License-Identifier: MIT
// The style as a map: how both styles look wherever the whole body may be in its movement. It takes the place of
// linear systems where examples are to be followed closely; what one joint does beyond it is kept as detail.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/representation/representation.h>
#include <strut/sysid/radial_basis.h>

namespace strut {

/// With phi the basis at the present context and the context a few frames ago: the input style looks like input phi,
/// the output style like output phi, both in normalized units. What the input has beyond input phi is its detail.
struct RadialMap {
  std::vector<int> lags;     ///< how old the contexts are that the basis sees, rising from 0 [frames] (lags)
  sysid::RadialBasis basis;  ///< over the contexts at every lag, the newest first (lags x contexts features)
  Eigen::MatrixXd input;     ///< (num_dofs x centres)
  Eigen::MatrixXd output;    ///< (num_dofs + 1 x centres); the last row is the log of the differential time warp
  double smoothing = 0.0;    ///< time constant of each of two low-pass filters in a row behind the output [frames]
  Eigen::VectorXd spread;    ///< deviation of the examples' own details, above 0 [units of the dof] (num_dofs)
  double fast = 0.0;         ///< of detail faster than a tenth of a second, how much is kept beside the share, 0 to 2
  Eigen::VectorXd share;     ///< of a detail of ordinary size that is kept, 0 to 1 (num_dofs)
};

/// Degrees of freedom whose detail is measured and kept as one: the root's velocities, its height, its tilt, a joint.
struct DetailPart {
  Eigen::Index first = 0, size = 0;  ///< columns of a row, at most three
  bool is_velocity = false;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< from the input style's axes to the output style's
};

/// The root's detail parts come first: its velocities, its height, its tilt.
inline constexpr int kRootDetailParts = 3;

/// To which of them a degree of freedom of the root belongs.
constexpr int root_detail_part(int dof) {
  using namespace representation;
  return dof < kHeight ? 0 : dof == kHeight ? 1 : 2;
}

/// The parts of a body, in the order of its degrees of freedom. Rotation vectors are seen from each style's mean
/// orientation of the joint; a detail keeps its direction in the parent's frame, which both styles share.
std::vector<DetailPart> detail_parts(const representation::Representation& input,
                                     const representation::Representation& output);

/// Throws InvalidArgument unless the parts of `map` fit each other, `num_dofs` and `num_contexts`.
void check_radial_map(const RadialMap& map, int num_dofs, int num_contexts);

}  // namespace strut
