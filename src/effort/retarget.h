// SPDX-License-Identifier: MIT
// A motion on another body of the same hierarchy: joints turn alike, travel and height grow with the legs.
#pragma once

#include <memory>

#include <strut/motion/motion.h>

namespace strut::effort {

/// Length of both legs, hip to ankle, as the bones have it [m]; of a body without legs the sum of its bones.
double leg_length(const Motion& motion);

/// `motion` on `skeleton`: the root's translation times `scale` (leg length there over leg length here); other bones
/// have their length there, and what they stretch here, times `scale`. Unchanged where the skeletons are equal and the
/// scale is 1. Throws SkeletonMismatch if names or hierarchy differ. Cost O(frames x joints).
Motion on_skeleton(const Motion& motion, const std::shared_ptr<const Skeleton>& skeleton, double scale);

/// Whether two skeletons have the same joints with the same offsets.
bool is_same(const Skeleton& a, const Skeleton& b);

}  // namespace strut::effort
