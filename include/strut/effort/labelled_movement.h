// SPDX-License-Identifier: MIT
// The movement that a label is about, as raters see it: a fragment's own frames and nothing before or after, or a blend
// made anew, moved and turned on the ground so that where and which way it was recorded tells nothing.
#pragma once

#include <strut/effort/fragment_database.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// A fragment or blend, on the database's skeleton, that starts above the origin and faces +Z on the average over its
/// frames. Throws InvalidArgument if there is no such fragment or blend, and what SpaceTimeBlend throws where two
/// fragments cannot be blended. Cost: a few milliseconds.
Motion labelled_movement(const FragmentDatabase& database, const LabelTarget& target);

}  // namespace strut::effort
