// SPDX-License-Identifier: MIT
// A human walk made from a few numbers, of which everything is known exactly: gait phase, footplants, path, and which
// frame of one walk corresponds to which frame of another. It serves demonstrations, and tests as ground truth.
//
// What is walked (content) and how (style) are apart. Content runs on its own clock, the content time: from it follow
// the steps, their order and the turning of each. A style walks the same steps at its own cadence and length, so two
// styles of one content differ in duration and correspond where their content times are equal.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/generate/schedule.h>
#include <strut/math/smooth_curve.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::generate {

/// Which foot; also `Footplant::foot`.
enum Foot { kLeft = 0, kRight = 1 };

/// What is walked. Schedules run over content time. The length of a step and its cadence follow from the speed at a
/// constant ratio, as people choose them (0.39 m per step/s; at 1.3 m/s: 0.71 m, 1.83 steps/s), with at least 1.2
/// steps/s; shorter and quicker sideways. Below 0.15 m/s (and 0.15 rad/s) the walker closes its feet and stands
/// until it is asked to go on.
struct WalkContent {
  double duration = 6.0;            ///< [s], (0, 3600]
  Schedule speed = 1.3;             ///< along the path [m/s], [0, 2.5]
  Schedule turn_rate = 0.0;         ///< of the direction faced [rad/s], positive to the left, |.| <= 2
  Schedule travel_direction = 0.0;  ///< of the path against the direction faced [rad]: pi/2 walks sideways to the left
  Foot first_foot = kLeft;          ///< which foot comes down at content time 0
};

/// How it is walked. The defaults are a relaxed adult walk.
struct WalkStyle {
  double cadence_scale = 1.0;      ///< steps per second, times the content's; (0.2, 3)
  double step_length_scale = 1.0;  ///< step length, times the content's; [0, 1.6); speed is scaled by both
  double step_width = 0.14;        ///< between the ankles' tracks [m]
  double crouch = 0.0;             ///< how much the pelvis is lowered [m], [0, 0.35]
  double bounce = 1.0;             ///< rise and fall of the pelvis, times the usual
  double hip_sway = 1.0;           ///< sideways shift and list of the pelvis, times the usual
  double hip_twist = 1.0;     ///< turning of the pelvis with the steps and of the chest against it, times the usual
  double arm_swing = 0.38;    ///< amplitude at the shoulder at 1.3 m/s [rad]
  double arm_spread = 0.12;   ///< of the upper arms away from the body [rad]
  double elbow_bend = 0.25;   ///< at rest [rad]
  double torso_lean = 0.04;   ///< forward [rad]
  double head_tilt = 0.0;     ///< nod, forward positive [rad]
  double foot_lift = 0.05;    ///< of the swinging foot, over what its roll gives [m]; 0.25 marches
  double toe_out = 0.10;      ///< of the feet [rad]
  double heel_strike = 0.32;  ///< foot against the ground as the heel comes down, toes up [rad]; 0 steps flat
  double push_off = 0.85;     ///< foot against the ground as the toes leave it, heel up [rad]
  double limp = 0.0;          ///< 0 none, 1 heavy: the bad leg carries shorter in time and space, the weight is
                              ///< thrown over it, its knee is kept stiff and swung around
  Foot limp_foot = kLeft;     ///< the bad leg
  double body_height = 1.75;  ///< [m], [0.8, 2.4]
  double variation = 1.0;     ///< natural difference from step to step: 0 none, 1 about 2 % of length and time
  std::uint64_t seed = 1;     ///< of the variation; the same seed gives the same walk
};

/// A point of the path on the ground, free of sway and bounce.
struct PathPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< y = 0 [m]
  double heading = 0.0;                                ///< direction faced about Y [rad], unwrapped; 0 faces +Z
};

/// A generated walk: vectors have an entry per frame.
struct Walk {
  Motion motion;
  std::vector<double> content_time;  ///< [s], strictly ascending
  std::vector<double> gait_phase;    ///< [cycles], never falls: the left foot comes down at whole numbers, the right
                                     ///< one half a cycle later; constant while standing
  std::vector<PathPoint> path;
  /// By foot, then frame. While a foot is planted its toe joint (the ball of the foot) does not move at all.
  std::vector<motion::Footplant> footplants;
  /// The part of each footplant in which the heel is down too: neither ankle nor toe joint moves.
  std::vector<motion::Footplant> flat_footplants;
  math::SmoothCurve timing;  ///< from content time to the motion's time [s]
};

/// The walker's skeleton: 21 joints, hips as root, T-pose as rest, metres. `height` [m]: of the head's top above
/// ground. Throws InvalidArgument if it is not in [0.8, 2.4].
std::shared_ptr<const Skeleton> walker_skeleton(double height = 1.75);

/// Walks `content` in `style`. The result depends on frame_rate [frames/s] only in where it is sampled.
/// Throws InvalidArgument for numbers outside the ranges above, or steps too long for the legs.
/// Cost: about 10 microseconds per frame.
Walk generate_walk(const WalkContent& content, const WalkStyle& style, double frame_rate = 60.0);

/// For each frame of `a`, the frame of `b` (with fraction, in [0, frames - 1]) at which the same content is done.
/// Throws InvalidArgument if the contents' durations differ.
std::vector<double> true_correspondence(const Walk& a, const Walk& b);

}  // namespace strut::generate
