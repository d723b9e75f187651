// SPDX-License-Identifier: MIT
// Which part of a body a joint belongs to, found from the body's shape and never from the joints' names.
#pragma once

#include <array>
#include <vector>

#include <strut/motion/motion.h>

namespace strut::motion {

enum class BodyPart { kTrunk, kHead, kLeftArm, kRightArm, kLeftLeg, kRightLeg };

inline constexpr int kNumBodyParts = 6;

/// "trunk", "head", "left_arm", ... in the order of BodyPart.
inline constexpr std::array<const char*, kNumBodyParts> kBodyPartNames = {"trunk",     "head",     "left_arm",
                                                                          "right_arm", "left_leg", "right_leg"};

/// The part of every joint (num_joints). Legs are those of legs.h, with everything below their hips. Arms are the
/// longest mirrored pair of limbs that leave the rest of the body at one joint; what else leaves it there is the head.
/// Everything else is trunk, and so is the whole of a body in which no legs are found. `motion` needs one frame,
/// standing. Throws InvalidArgument if it has none. Cost O(frames x joints).
std::vector<BodyPart> body_parts(const Motion& motion);

}  // namespace strut::motion
