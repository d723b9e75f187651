// SPDX-License-Identifier: MIT
// Clips as no training take shows them, made from real ones, and what a model made of them: the inputs of the quality
// study's tests of details and of unfamiliar motion. Joints are told apart by the skeleton's shape alone; which joint a
// variation moves is the caller's choice.
#pragma once

#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::quality {

/// A clip that was varied, and where.
struct VariedClip {
  Motion motion;
  motion::FrameRange frames;  ///< in which the variation is there in full
};

/// The movement of `joint` about its mean orientation, `factor` times as large.
VariedClip exaggerated(const Motion& clip, int joint, double factor);

/// Which way a joint is bent besides what it does already.
enum class Direction {
  kMost,   ///< about the axis about which it moves most in the clip
  kLeast,  ///< about the axis about which it moves least
};

/// `joint` turned back and forth by `amplitude` [rad], `frequency` times a second, from the first frame on.
VariedClip bent(const Motion& clip, int joint, Direction direction, double amplitude, double frequency);

/// What hangs on `joint` lifted sideways, away from the body, by `angle` [rad] in the clip's middle third.
VariedClip raised(const Motion& clip, int joint, double angle);

/// The pelvis lowered by `share` of the legs' length in the clip's middle third, the knees bent and the feet where they
/// were. Throws InvalidArgument for a body without legs.
VariedClip ducked(const Motion& clip, double share);

/// The poses of `other` in the clip's middle third. Throws InvalidArgument unless it has as many frames and joints.
VariedClip replaced(const Motion& clip, const Motion& other);

/// The clip slowed down to a halt at its middle, standing still for `seconds`, and going on.
VariedClip halted(const Motion& clip, double seconds);

/// The clip `factor` times as long.
VariedClip stretched(const Motion& clip, double factor);

/// The clip by a body `factor` times as tall.
VariedClip resized(const Motion& clip, double factor);

/// What a variation of one joint did to a translated clip.
struct Response {
  double share = 0.0;        ///< of the difference's energy, summed over joints' rotations, that is in that joint
  double correlation = 0.0;  ///< of that joint's difference in the output with the one in the input
  double gain = 0.0;         ///< root mean square of the former over that of the latter
};

/// The differences between two inputs and between their outputs, all four of as many frames. A joint's difference is
/// the rotation vector [rad] from its rotation in the one clip to that in the other, in its parent's frame (the
/// pelvis's in the world); joints above the pelvis count as part of it. The energy is the sum of squares over frames
/// and components; the correlation is Pearson's, the three components' deviations from their means taken together.
/// A difference that is not there at all has no share and no correlation: both 0.
/// Throws InvalidArgument if numbers of frames differ.
Response response(const Motion& input, const Motion& varied_input, const Motion& output, const Motion& varied_output,
                  int joint);

/// The mean distance of the joints, relative to the hips and the heading, of two clips laid on each other frame by
/// frame [m], over `frames`. Throws InvalidArgument if a clip does not have them.
double frame_distance(const Motion& first, const Motion& second, const motion::FrameRange& frames);

}  // namespace strut::quality
