// SPDX-License-Identifier: MIT
// The walker as lines to draw: joints and tips, what hangs on what, and which side it belongs to.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/motion/motion.h>

namespace strut::cli {

/// How the points of body_points hang together.
struct BodyDrawing {
  std::vector<int> parents;  ///< per point, -1 for the root
  std::vector<int> sides;    ///< per point: 0 middle, 1 left, 2 right
  int head = 0;              ///< the point on top
};

/// The skeleton's joints, then its tips.
BodyDrawing body_drawing(const Skeleton& skeleton);

/// The points of a pose, world [m].
std::vector<Eigen::Vector3d> body_points(const Skeleton& skeleton, const Pose& pose);

}  // namespace strut::cli
