// SPDX-License-Identifier: MIT
// The curves of a motion that the page can ask for: a value per frame of a joint's degrees of freedom, of its speed and
// jerk, and of the body as a whole. What they are is computed by the library (motion/joint_curves.h, metrics/).
#pragma once

#include "view/container.h"

#include <string>
#include <vector>

#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::cli {

/// [{name, joint, label, unit}], CurveInfo of viewer/src/data/types.ts: of the body first, then of every joint. A name
/// begins with "body" or the joint's index, because joints may share a name or have none. Speed, jerk and what is of
/// the body are missing for a body without legs, and for a clip of fewer than four frames at 30 frames/s. Cost O(frames
/// x joints).
Container::Json curves_of(const Motion& motion);

/// The curve `name` of curves_of(): a number per frame, NaN for none. Throws Refusal (404) if the motion has no such
/// curve. Cost O(frames x joints).
std::vector<float> curve_values(const Motion& motion, const std::string& name);

/// The same as the array "values" of a container.
Container curve_answer(const Motion& motion, const std::string& name);

/// The slide of the left and the right foot at every frame [frames][2] (m/s), NaN where the foot is not planted or the
/// clip is too short for it.
std::vector<float> slide_of(const Motion& motion, const std::vector<motion::Footplant>& plants);

}  // namespace strut::cli
