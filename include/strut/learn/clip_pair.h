// SPDX-License-Identifier: MIT
// Which stretch of which clip in the input style belongs to which stretch in the output style. Clips that travel are
// cut into gait cycles and paired by foot, turning and speed (two recordings of a walk have different numbers of steps,
// so whole clips must not be aligned); clips without travel are paired whole, trimmed to the part that moves.
#pragma once

#include <string>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/learn/gait_cycles.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::learn {

using motion::FrameRange;

/// What a pair is made of.
enum class PairKind {
  kGaitCycle,  ///< one cycle each, of the same foot
  kWhole,      ///< two clips without travel, trimmed to the part that moves
};

/// What a stretch of motion was matched by.
struct PairFeatures {
  double duration = 0.0;  ///< [s]
  double speed = 0.0;     ///< along the path [m/s]; 0 for whole clips
  double turning = 0.0;   ///< over the stretch [rad], positive to the left; 0 for whole clips
  double movement = 0.0;  ///< how far the body's joints move about the pelvis, mean over joints [m]; 0 for cycles
};

/// One pair.
struct ClipPair {
  int input_clip = 0;        ///< index into the clips of the input style
  int output_clip = 0;       ///< index into the clips of the output style
  FrameRange input_frames;   ///< at the input clip's own rate
  FrameRange output_frames;  ///< at the output clip's own rate
  int slope_limit = 2;       ///< a frame of one may take this many of the other: what alignment should allow
  PairKind kind = PairKind::kWhole;
  int foot = 0;           ///< of gait cycles: whose footplants begin and end them (0 left, 1 right)
  PairFeatures input;     ///< what the input was matched by
  PairFeatures output;    ///< what the output was matched by
  double distance = 0.0;  ///< between the features, 0 = alike, about 1 = different to the eye
};

}  // namespace strut::learn
