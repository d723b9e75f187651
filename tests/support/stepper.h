// SPDX-License-Identifier: MIT
// A body whose feet are put exactly where a test wants them, for tests of footplants and gait cycles: a pelvis that
// goes along a path, and ankles and toes that stand and step (the bones stretch; nothing here looks like a person).
#pragma once

#include <vector>

#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::test {

/// How the stepping body goes. Feet alternate, the left lands first, half a cycle apart.
struct Steps {
  int cycles = 4;             ///< of each foot
  double cycle_time = 1.0;    ///< [s]
  double stance = 0.6;        ///< share of the cycle in which a foot stands
  double stride = 1.2;        ///< way per cycle [m]
  double turning = 0.0;       ///< per cycle [rad]
  double scale = 1.0;         ///< of the body
  double drag = 0.0;          ///< 1: feet are not lifted at all
  double frame_rate = 30.0;   ///< [frames/s]
  double pause_after = -1.0;  ///< a halt begins at this time [s]; negative: none
  double pause = 0.0;         ///< how long it lasts [s]
};

struct SteppingBody {
  Motion motion;
  std::vector<motion::Footplant> footplants;  ///< exact, to the frame
};

SteppingBody stepping_body(const Steps& steps);

}  // namespace strut::test
