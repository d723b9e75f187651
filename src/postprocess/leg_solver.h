// SPDX-License-Identifier: MIT
// A leg of two bones in closed form: how thigh and shin turn so that the ankle comes to a given place. The knee keeps
// its plane and way of bending; close to straight its bend is damped and the bones stretch instead (Kovar et al.
// 2002, 4.3), so that the knee never snaps.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace strut::postprocess::detail {

/// How a leg comes to reach.
struct LegSolution {
  Eigen::Quaterniond thigh_turn = Eigen::Quaterniond::Identity();  ///< in the world, before the thigh's own rotation
  Eigen::Quaterniond shin_turn = Eigen::Quaterniond::Identity();   ///< the same of the shin
  double stretch = 1.0;                                            ///< of both bones, >= 1
  bool changed = false;                                            ///< false: the bones have no length, or no direction
};

/// `thigh` from hip to knee, `shin` from knee to ankle, `wanted` from hip to where the ankle is to be [m].
/// `bend_axis`: unit, about which the shin turns against the thigh when the knee bends. `max_stretch` as a share.
LegSolution solve_leg(const Eigen::Vector3d& thigh, const Eigen::Vector3d& shin, const Eigen::Vector3d& wanted,
                      const Eigen::Vector3d& bend_axis, double max_stretch);

}  // namespace strut::postprocess::detail
