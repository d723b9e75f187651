// SPDX-License-Identifier: MIT
// What a BVH file leaves unsaid, judged from the size and the stance of its skeleton.
#pragma once

#include <vector>

#include <strut/io/bvh.h>
#include <strut/motion/motion.h>

namespace strut::io::detail {

/// The extent of a body (pelvis and below in the hierarchy) along the file's axes.
struct BodyExtent {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();   ///< smallest coordinates
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< largest minus smallest

  [[nodiscard]] double largest() const { return size.maxCoeff(); }
};

/// The extent of `pose`, end sites included.
BodyExtent body_extent(const Skeleton& skeleton, const Pose& pose);

/// The unit in which a skeleton of size `height` is nearest to a grown person's, by ratio.
LengthUnit guess_unit(double height);

/// The axis along which the body stands: by its first frame, and by its rest pose where that is one.
UpAxis guess_up(const BodyExtent& first_frame, const BodyExtent& rest);

}  // namespace strut::io::detail
