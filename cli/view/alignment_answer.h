// SPDX-License-Identifier: MIT
// Which moment of one clip belongs to each frame of another, as the page plays them together: what strut align finds.
#pragma once

#include "view/container.h"
#include "view/workspace.h"

namespace strut::cli {

/// The container of AlignmentHeader (viewer/src/data/types.ts) with the array "moments" (frames of `reference`): where
/// in `clip` each of them is, in frames of `clip` as it was recorded, rising, inside it. The warp is smoothed, as
/// playing needs it. Throws BadInput for clips too short, too long (docs/viewer.md), in which nothing moves, or of
/// lengths that are too far apart, and SkeletonMismatch.
Container alignment_answer(const ViewClip& reference, const ViewClip& clip, const FeetOptions& feet);

}  // namespace strut::cli
