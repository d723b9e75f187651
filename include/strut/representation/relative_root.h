// SPDX-License-Identifier: MIT
// The root of a body as style translation sees it (Hsu et al. 2005, 4.1): where the body is and where it faces are
// given relative to the previous frame, so that moving or turning a clip on the ground changes nothing. "Root" is the
// pelvis, with the chain of joints above it folded in.
#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/motion/motion.h>

namespace strut::representation {

/// Where the root's degrees of freedom stand in a row.
enum RootDof {
  kSidewaysVelocity,  ///< to the body's left, in the heading frame [m/s]
  kForwardVelocity,   ///< [m/s]
  kTurningRate,       ///< about the vertical, counter-clockwise seen from above [rad/s]
  kHeight,            ///< of the pelvis above the ground [m]
  kTiltX,             ///< rotation vector of what is left once the heading is taken out [rad]; its Y is always zero
  kTiltZ,
  kNumRootDofs
};

/// A body's place on the ground and the way it faces.
struct RootPlacement {
  double x = 0.0, z = 0.0;  ///< position of the pelvis on the ground plane [m]
  double heading = 0.0;     ///< [rad]
};

/// The pelvis in the world.
struct RootTransform {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// Composes the chain from the skeleton's root down to the pelvis.
RootTransform pelvis_world(const Skeleton& skeleton, const Pose& pose);

/// The place and heading of a pelvis. `upright` is the pelvis rotation of a body that stands upright facing +Z.
RootPlacement placement(const RootTransform& root, const Eigen::Quaterniond& upright);

/// The root's degrees of freedom at one frame, `frame_time` [s] after the frame that was at `previous`, which becomes
/// where this one is.
std::array<double, kNumRootDofs> encode_root(const RootTransform& root, RootPlacement& previous,
                                             const Eigen::Quaterniond& upright, double frame_time);

/// The pelvis that `encode_root` saw, and its placement written to `previous` for the next frame. Turning is integrated
/// with the heading half way between the frames, so that encoding and decoding are exact inverses.
RootTransform decode_root(const std::array<double, kNumRootDofs>& dofs, RootPlacement& previous,
                          const Eigen::Quaterniond& upright, double frame_time);

}  // namespace strut::representation
