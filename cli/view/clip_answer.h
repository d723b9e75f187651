// SPDX-License-Identifier: MIT
// A motion as the page shows it: where its points are, when its feet stand, and what was measured of it.
#pragma once

#include "feet_options.h"
#include "view/container.h"

#include <string>

#include <strut/core/diagnostics.h>
#include <strut/motion/motion.h>

namespace strut::cli {

/// How positions are sent: as they are, or small, for a file that is passed on.
enum class Packing { kExact, kSmall };

/// How far a position that is packed small may be off [m].
inline constexpr double kLargestPackingError = 1e-4;

/// The container of ClipHeader (viewer/src/data/types.ts) with the arrays "positions" [frames][points][3] (m) and
/// "slide" [frames][2] (m/s). Points are the joints, then the tips of those that have one. Packed small, "pelvisPath"
/// [frames][3] and "aroundPelvis", the positions from there in 16 bits, stand for "positions" unless they would be off
/// by more than kLargestPackingError. `feet`: of a body that has them; one that has not is told in the notes. Cost
/// O(frames x joints).
Container clip_answer(const std::string& id, const std::string& name, const Motion& motion, Diagnostics notes = {},
                      Packing packing = Packing::kExact, const FeetOptions& feet = {});

}  // namespace strut::cli
