// SPDX-License-Identifier: MIT
// Cuts a motion into single gait cycles: from each footplant's onset to the next of the same foot, for the left foot
// and for the right. Neighbouring cycles of the two feet overlap by half.
#pragma once

#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/motion/annotation.h>
#include <strut/motion/legs.h>
#include <strut/motion/motion.h>

namespace strut::motion {

/// One gait cycle.
struct GaitCycle {
  FrameRange frames;      ///< from the onset of a footplant of `foot` to the next
  int foot = 0;           ///< 0 left, 1 right
  double duration = 0.0;  ///< [s]
  double speed = 0.0;     ///< of the pelvis along its path over the ground [m/s]
  double turning = 0.0;   ///< of the way the body faces over the cycle [rad], positive to the left
};

/// Cuts `motion` at the onsets of `footplants` (as detect_footplants gives them). A footplant that begins with the clip
/// has no onset. Left out are cycles no gait has: shorter than 0.25 s or longer than 2.5 s, without exactly one onset
/// of the other foot inside, and those much longer than the motion's others (a halt); each is reported as a note.
/// Returns the cycles in order of their beginning. Cost O(frames x joints).
std::vector<GaitCycle> gait_cycles(const Motion& motion, const Legs& legs, const std::vector<Footplant>& footplants,
                                   Diagnostics* diagnostics = nullptr);

}  // namespace strut::motion
