// SPDX-License-Identifier: MIT
// What descriptors need to know of a body: its hands, its measures, and how its mass is shared out among its joints.
// All of it is found from bone lengths and from where the legs are, never from names or a pose.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/motion/motion.h>

namespace strut::effort::detail {

struct BodyShape {
  int pelvis = 0;
  std::vector<int> hands;   ///< the ends of the arms; of all limbs but legs where there are none
  int shoulders = 0;        ///< the joint at which the arms part; the pelvis where there are none
  double arm_length = 1.0;  ///< from there to a hand [m]
  double leg_length = 1.0;  ///< hip to ankle [m]
  Eigen::VectorXd mass;     ///< share of the body at each joint, 1 in all (num_joints)
};

/// Cost O(frames x joints + leaves^2 joints).
BodyShape body_shape(const Motion& motion);

}  // namespace strut::effort::detail
