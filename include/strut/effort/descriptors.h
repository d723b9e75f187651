// SPDX-License-Identifier: MIT
// How a fragment moves, in a few numbers of its own kinematics: what estimates of Effort are made from.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include <strut/motion/motion.h>

namespace strut::effort {

// The order of the descriptors is kDescriptorNames'.
inline constexpr int kNumDescriptors = 4;
inline constexpr std::array<const char*, kNumDescriptors> kDescriptorNames = {
    "log_acceleration", "hand_smoothness", "height", "peak_deceleration"};

/// Of one fragment: log of the mean weighted joint acceleration, SPARC of the hands' speed (Balasubramanian et al.
/// 2015), height of the centre of mass, peak deceleration with the speed regressed out later, within the group.
/// Throws InvalidArgument if the motion has fewer than 4 frames. Cost O(frames x joints).
Eigen::VectorXd describe(const Motion& motion);

/// z-scores within one group of like content: (fragments x kNumDescriptors), mean 0 and deviation 1 per column; 0 where
/// nothing varies.
struct DescriptorScale {
  Eigen::VectorXd mean, deviation;
};

}  // namespace strut::effort
