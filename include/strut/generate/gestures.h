// SPDX-License-Identifier: MIT
// Gestures made from a few numbers, of which everything is known exactly: what is done, by whom, with which Effort, and
// which frame of one corresponds to which frame of another. They serve tests and the study of the Effort engine.
//
// What is done (content) is a path of postures over a content time. A style sets how the content time runs (its pace
// and evenness), how much the body sinks, how far and how curved the arms go; a performer adds a body and habits. The
// body is the walker's, feet planted by inverse kinematics.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <strut/math/smooth_curve.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::generate {

/// What a posture is told by: lengths [m] for a body of 1.75 m, angles [rad]. Turns are positive to the left.
enum PosturePart {
  kPelvisDrop,     ///< below where the legs are nearly straight
  kPelvisForward,  ///< of the middle between the feet of a standing body
  kPelvisSide,     ///< to the left
  kPelvisTurn,
  kPelvisLean,  ///< forward
  kSpineBend,   ///< forward, of spine and chest together
  kSpineSide,   ///< to the left
  kSpineTurn,
  kNod,               ///< of the head, against the trunk
  kLook,              ///< turn of the head, against the trunk
  kRightFootForward,  ///< where the right foot stands
  kLeftFlexion,       ///< of the upper arm, forward
  kLeftSpread,        ///< of the upper arm, sideways
  kLeftTwist,         ///< of the upper arm about itself
  kLeftElbow,
  kLeftWrist,
  kRightFlexion,
  kRightSpread,
  kRightTwist,
  kRightElbow,
  kRightWrist,
  kNumPostureParts,
};
using Posture = std::array<double, kNumPostureParts>;

/// A body standing at rest, arms hanging.
Posture rest_posture();

/// A posture on the way, and the stroke that leads there.
struct GestureKey {
  double duration = 0.5;  ///< of the stroke, in content time [s]
  double accent = 0.0;    ///< 0 a transition ... 1 the stroke the gesture is about: Effort shows in it most
  Posture posture{};
};

/// What is done: from rest_posture() through the keys.
struct GestureContent {
  std::string name;
  std::vector<GestureKey> keys;
  [[nodiscard]] double duration() const;  ///< in content time [s]
};

enum class GestureAction { kReach, kWave, kPunch, kThrow, kLift, kPress, kBow, kLunge };
inline constexpr int kNumGestureActions = 8;

/// One of eight actions, the right hand's where one hand does it.
GestureContent gesture_content(GestureAction action);

/// How it is done. The first three are Effort's settings, each from -1 to 1.
struct GestureStyle {
  double suddenness = 0.0;  ///< pace, and how much of it is put into the accented strokes
  double boundness = 0.0;   ///< -1: strokes flow into each other, hands follow late; 1: halting, each stroke stopped,
                            ///< trembling a little
  double strength = 0.0;    ///< how far the body sinks and leans in, how late and hard the accents stop
  double extent = 1.0;      ///< of the arms' and trunk's way, times the usual, [0.4, 1.6]
  double curvature = 0.0;   ///< of the arms' way, to the outside positive, [-1, 1]
  double variation = 1.0;   ///< natural difference from one time to the next: 0 none, 1 about 0.04 rad and 6 % of pace
  std::uint64_t seed = 1;   ///< of the variation
};

/// Who does it. The defaults have no habits.
struct Performer {
  double height = 1.75;     ///< [m], [1.2, 2.1]
  double tempo = 1.0;       ///< times the usual, [0.5, 2]
  double expression = 1.0;  ///< how much of Effort's settings shows, [0, 1.5]
  double extent = 1.0;      ///< times the usual, [0.6, 1.4]
  double crouch = 0.0;      ///< of the standing body [m], [0, 0.1]
  double hunch = 0.0;       ///< of the trunk, forward [rad], [-0.3, 0.6]
  double arm_spread = 0.0;  ///< added to the usual [rad]
  double elbow_bend = 0.0;  ///< added to the usual [rad]
  double stance = 0.22;     ///< between the ankles [m], [0.1, 0.4]
  double tremor = 0.0;      ///< of the arms, without any boundness [rad], [0, 0.05]
  double habit = 0.0;       ///< of the performer's own postures, deviation from the content's [rad], [0, 0.3]
  std::uint64_t seed = 1;   ///< of the habits
};

/// One of any number of performers, by number from 0; the same for the same number and seed.
Performer performer(int number, std::uint64_t seed = 1);

/// A generated gesture: vectors have an entry per frame.
struct Gesture {
  Motion motion;
  std::vector<double> content_time;           ///< [s], strictly ascending from 0 to the content's duration
  std::vector<motion::Footplant> footplants;  ///< while a foot is planted neither ankle nor toe joint moves
  math::SmoothCurve timing;                   ///< from content time to the motion's time [s]
};

/// Does `content` in `style` as `who`. The result depends on frame_rate [frames/s] only in where it is sampled.
/// Throws InvalidArgument for numbers outside the ranges above or a content without keys. Cost: about 10 microseconds
/// per frame.
Gesture generate_gesture(const GestureContent& content, const GestureStyle& style = {}, const Performer& who = {},
                         double frame_rate = 60.0);

/// For each frame of `a`, the frame of `b` (with fraction, in [0, frames - 1]) at which the same content is done.
/// Throws InvalidArgument if the contents' durations differ.
std::vector<double> true_correspondence(const Gesture& a, const Gesture& b);

/// A gesture of the standard set, with what it was made from.
struct StandardGesture {
  GestureAction action = GestureAction::kReach;
  int performer = 0;  ///< 0 ... 4
  GestureStyle style;
  Gesture gesture;
};

/// 240 gestures: eight actions by five performers in six settings each, in that order. Of the six, each of Effort's
/// settings takes every sixth of [-1, 1] once, in an order of its own. 30 frames/s unless asked otherwise.
std::vector<StandardGesture> standard_gestures(std::uint64_t seed = 1, double frame_rate = 30.0);

}  // namespace strut::generate
