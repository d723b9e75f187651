// SPDX-License-Identifier: MIT
// Finds when feet are planted from how they move: from a motion to footplants. A foot is planted while its toe (the
// ball of the foot) is held still: what footskate cleanup can hold. The heel may come down a little earlier and leaves
// earlier. A foot without a toe is judged by its ankle. First the stretches are found in which the toe is low and slow
// for this clip and this foot, with hysteresis; then each is cut down to where the toe is as still as it gets there.
// Thresholds are shares of the foot's own speed and of the leg's length, so that runs, shuffles, feet that slide (those
// of translated clips) and bodies of any size need no settings.
#pragma once

#include <vector>

#include <strut/motion/annotation.h>
#include <strut/motion/legs.h>
#include <strut/motion/motion.h>

namespace strut::postprocess {

/// When a foot counts as planted.
struct FootplantDetectorOptions {
  double landing_speed = 0.12;   ///< up to this share of the way from the foot's slow speed to its fast, it is slow
  double leaving_speed = 0.20;   ///< faster than this share, it has left; at least landing_speed
  double least_speed = 0.15;     ///< but below this many leg lengths a second a foot always counts as slow
  double height = 0.06;          ///< higher than this above its ground level [leg lengths], it has not landed
  double leaving_height = 0.12;  ///< higher than this, it has left; at least height
  double held_speed = 0.0005;    ///< up to this many leg lengths a second a toe that lands has come to rest,
  double released_speed = 0.04;  ///< and up to this many one that rolls off still stands; at least held_speed
  double held_spread = 3.0;      ///< or up to this many times what it moves at in the middle of that footplant
  double longest_gap = 0.12;     ///< shorter interruptions are closed if the foot does not go anywhere meanwhile [s]
  double shortest_plant = 0.08;  ///< shorter footplants are dropped, but for those cut by the clip's ends [s]
};

/// The footplants of both feet (0 left, 1 right), by foot, then begin; those of one foot never touch.
/// A plant that is under way when the clip begins or ends begins at frame 0 or ends at the last.
/// Throws InvalidArgument if an option is negative or a threshold for leaving is below that for landing.
/// Cost O(frames x joints).
std::vector<motion::Footplant> detect_footplants(const Motion& motion, const motion::Legs& legs,
                                                 const FootplantDetectorOptions& options = {});

}  // namespace strut::postprocess
