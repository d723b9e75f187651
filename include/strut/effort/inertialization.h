// SPDX-License-Identifier: MIT
// Joins of motions, one after the other, without a pop: each goes on from where and how fast the last was moving, and
// what they differ by at the join dies away over a few tenths of a second (inertialization; Bollo 2018).
#pragma once

#include <vector>

#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// How long a join is felt.
struct JoinOptions {
  double longest_decay = 0.4;   ///< over which differences die away [s], at least shortest_decay, at most 2
  double shortest_decay = 0.2;  ///< where a difference is closing by itself, and would be overshot, as short [s], > 0
  /// Differences are shared by both sides of a join, so that each accelerates half as much. False: only what comes
  /// after a join gives way, as it must where frames are shown while they are made.
  bool looks_ahead = true;
};

/// What is joined: a motion, and where it is from, if that is known.
struct Piece {
  Motion motion;
  int source = -1;       ///< a number per recording; -1: of its own
  int source_begin = 0;  ///< the recording's frame that is the motion's first
};

/// Motions joined to one.
struct JoinedMotion {
  Motion motion;
  std::vector<int> begins;  ///< the frame at which each piece begins
};

/// Plays `pieces` one after the other: a piece's first frame comes one frame after the last's last. The root's place
/// and heading go on from there, its steps and turns carried on by integration; what velocities differ by fades out.
/// Height, tilt, rotations and bones differ at the join by D, which grows at a rate V (both sides continued to the
/// middle of the step between them). The difference is shared by both sides (looks_ahead), and on each follows the
/// quintic with this D and V that ends at rest after the decay: longest_decay, less where V leads back to zero before
/// that, each joint by itself. Where a piece is shorter than its decay, the next join takes over what is left.
/// Pieces of one source that follow each other there stay as they are; so do others where no joint's velocity changes
/// over the join by more than twice what it does within 0.4 s of it. The result is on the first piece's skeleton and
/// starts where it does. Throws InvalidArgument if there is no piece, one has no frame, the rates differ or an option
/// is out of range, SkeletonMismatch if the hierarchies differ. Cost O(frames x joints).
JoinedMotion join(const std::vector<Piece>& pieces, const JoinOptions& options = {});

/// The same of motions that are each of their own.
JoinedMotion join(const std::vector<Motion>& pieces, const JoinOptions& options = {});

/// The footplants of every piece, in the frames of what they were joined to, by foot, then begin; plants that touch
/// over a join are one. `plants`: of each piece, in its frames. Throws InvalidArgument if the numbers differ.
std::vector<motion::Footplant> joined_plants(const JoinedMotion& joined,
                                             const std::vector<std::vector<motion::Footplant>>& plants);

}  // namespace strut::effort
