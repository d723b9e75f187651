// SPDX-License-Identifier: MIT
// Where motions are to be joined: how they begin and end, how well an end goes with a beginning, and which of the
// candidates that follow one another go best together.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/effort/fragment_features.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// What postures are compared in.
struct PostureSpace {
  const Eigen::Quaterniond& upright;
  const FeatureSpace& space;
  double unit;  ///< the distance that counts 1 [m]
};

/// A motion's posture and how it changes, at a frame.
struct MotionEdge {
  Eigen::VectorXd posture;    ///< [m]
  Eigen::VectorXd velocity;   ///< [m/s]
  double acceleration = 0.0;  ///< the largest of a joint within 0.1 s of there [rad/s^2]; 0 where it is not asked for
};

/// Of every frame in [begin, end), velocities by the step to the next frame, or from the last at the motion's end.
/// Throws InvalidArgument if the space is of another skeleton.
std::vector<MotionEdge> edges_within(const Motion& motion, int begin, int end, const PostureSpace& in);

/// The largest angular acceleration of a joint at the inner frames within [begin, end) [rad/s^2]; 0 without any.
double largest_acceleration(const Motion& motion, int begin, int end);

/// The angular accelerations of all joints at all inner frames [rad/s^2].
std::vector<double> joint_accelerations(const Motion& motion);

/// The edges of a motion of at least one frame, with their accelerations.
MotionEdge beginning(const Motion& motion, const PostureSpace& in);
MotionEdge ending(const Motion& motion, const PostureSpace& in);

/// How far `next`, a frame after `last`, is from going on there: squared, in units, the distance of postures with
/// `last` gone on for that frame, and what the velocities would come apart by in 0.1 s.
double misfit(const MotionEdge& last, const MotionEdge& next, double frame_time, double unit);

/// One of the motions that may stand at a place in a sequence.
struct SequenceCandidate {
  double price = 0.0;  ///< by itself
  MotionEdge begin, end;
};

/// The candidate of each place (each with at least one) for which the sum of prices and of `join_weight` times the
/// misfits is least, by dynamic programming. Ties go to the first. Cost O(places candidates^2).
std::vector<std::size_t> cheapest_sequence(const std::vector<std::vector<SequenceCandidate>>& places,
                                           double join_weight, double frame_time, double unit);

}  // namespace strut::effort
