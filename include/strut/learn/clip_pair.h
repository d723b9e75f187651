// SPDX-License-Identifier: MIT
// Which stretch of which clip in the input style belongs to which stretch in the output style. Clips that travel are
// cut into gait cycles and paired by foot, turning and speed (two recordings of a walk have different numbers of steps,
// so whole clips must not be aligned); clips without travel are paired whole, trimmed to the part that moves.
#pragma once

#include <string>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::learn {

using motion::FrameRange;

/// What a pair is made of.
enum class PairKind {
  kGaitCycle,  ///< one cycle each, of the same foot
  kWhole,      ///< two whole clips, trimmed to the part that moves
};

/// What a stretch of motion is matched by.
struct PairFeatures {
  double duration = 0.0;  ///< [s]
  double speed = 0.0;     ///< of the pelvis along its path over the ground [m/s]
  double turning = 0.0;   ///< of the way the body faces, over the stretch [rad], positive to the left
  double movement = 0.0;  ///< root mean square distance of the joints from their mean places about the pelvis [m]
};

/// A stretch of a clip that can be paired.
struct Stretch {
  int clip = 0;       ///< index into the clips of its style
  FrameRange frames;  ///< at the clip's own rate
  PairKind kind = PairKind::kWhole;
  int foot = 0;           ///< of gait cycles: whose footplants begin and end it (0 left, 1 right)
  PairFeatures features;  ///< what it is matched by
};

/// One pair.
struct ClipPair {
  int input_clip = 0;        ///< index into the clips of the input style
  int output_clip = 0;       ///< index into the clips of the output style
  FrameRange input_frames;   ///< at the input clip's own rate
  FrameRange output_frames;  ///< at the output clip's own rate
  int slope_limit = 2;       ///< what alignment should allow: a frame of one may take this many of the other
  PairKind kind = PairKind::kWhole;
  int foot = 0;           ///< of gait cycles: whose footplants begin and end them (0 left, 1 right)
  PairFeatures input;     ///< what the input was matched by
  PairFeatures output;    ///< what the output was matched by
  double distance = 0.0;  ///< between the features: 0 alike, 1 different to the eye
  std::string name = {};  ///< what reports call it; empty: by the clips' indices
};

/// Anything shorter is no movement that could be aligned or paired [s].
constexpr double kShortestStretch = 0.2;

/// How stretches are matched.
struct PairingOptions {
  int neighbours = 6;           ///< style stretches that every input stretch is paired with, >= 1
  bool whole = false;           ///< pair whole clips even where they travel
  double turning_scale = 0.35;  ///< difference in turning that counts as 1 [rad], > 0
  double speed_weight = 0.5;    ///< of speed, in standard deviations of each style's own speeds, >= 0
  postprocess::FootplantDetectorOptions footplants{};  ///< where gait cycles are cut
};

/// A pair that was looked at and not made.
struct RefusedPair {
  Stretch input, output;
  std::string reason;  ///< e.g. "one lasts 3.4 times as long as the other"
};

/// What pairing found.
struct Pairing {
  std::vector<ClipPair> pairs;       ///< by input clip, then begin, then distance
  std::vector<Stretch> inputs;       ///< every stretch of the input style, by clip, then begin
  std::vector<Stretch> outputs;      ///< every stretch of the output style
  std::vector<RefusedPair> refused;  ///< nearest ones that cannot be used; at most `neighbours` per input
  std::vector<Stretch> uncovered;    ///< input stretches of which no pair could be made
};

/// The slope limit that aligning stretches of these durations [s] takes: 2 as in the paper, 3 where they differ by more
/// than a factor of 1.8; 0 where they differ by more than 3 and cannot be aligned. Throws InvalidArgument if a duration
/// is not positive.
int slope_limit_for(double input_duration, double output_duration);

/// The part of a clip that moves: from shortly before its first movement to shortly after its last, so that standing
/// still at the ends does not take part. A clip in which nothing moves is kept whole. Cost O(frames x joints).
FrameRange moving_part(const Motion& motion);

/// The stretches of `clips` that can be paired: the gait cycles of clips that travel, and the moving parts of the
/// others (of all with `options.whole`). Reports what was left out. Cost O(frames x joints).
std::vector<Stretch> stretches_of(const std::vector<Motion>& clips, const PairingOptions& options = {},
                                  Diagnostics* diagnostics = nullptr);

/// Pairs clips of two styles. Every gait cycle of the input style gets its nearest cycles of the same foot in the
/// output style, by turning and by speed relative to each style's own speeds; every whole clip its nearest whole clips,
/// by duration and movement relative to the style's own, and by turning. All clips are of one skeleton. Throws
/// InvalidArgument if there are no clips or an option is out of range. Reports clips that were not used, kinds that the
/// other style lacks, and inputs that nothing in the output style is like. The list is empty where no pair can be made.
/// Cost O(frames x joints + input stretches x output stretches).
Pairing find_pairs(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs,
                   const PairingOptions& options = {}, Diagnostics* diagnostics = nullptr);

}  // namespace strut::learn
