// SPDX-License-Identifier: MIT
// A motion as the page shows it: where its points are, when its feet stand, and what was measured of it.
#pragma once

#include "feet_options.h"
#include "view/container.h"

#include <string>

#include <strut/core/diagnostics.h>
#include <strut/motion/motion.h>

namespace strut::cli {

/// The container of ClipHeader (viewer/src/data/types.ts) with the arrays "positions" [frames][points][3] (m) and
/// "slide" [frames][2] (m/s). Points are the joints, then the tips of those that have one. `feet`: of a body that has
/// them; one that has not is told in the notes. Cost O(frames x joints).
Container clip_answer(const std::string& id, const std::string& name, const Motion& motion, Diagnostics notes = {},
                      const FeetOptions& feet = {});

}  // namespace strut::cli
