// SPDX-License-Identifier: MIT
// Exponential and logarithm maps (rotation.h) of many joints at once, as vector instructions: what encoding and
// decoding a frame costs. Numbers stand in planes: all x, all y, all z, and for quaternions all w.
#pragma once

namespace strut::math {

/// Largest error of the maps below, for angles up to a turn: of a component of a unit quaternion, and [rad].
template <typename Scalar>
inline constexpr Scalar kRotationArrayError = Scalar(0);
template <>
inline constexpr float kRotationArrayError<float> = 1e-6F;
template <>
inline constexpr double kRotationArrayError<double> = 4e-15;

/// A rotation vector is kept continuous up to this angle [rad]: beyond it the shortest is taken, so that a joint that
/// was spun once, or a recording that broke, does not stay wound up for good.
template <typename Scalar>
inline constexpr Scalar kFarthestAngle = Scalar(1.5 * 3.14159265358979323846);

/// `rotations` (4 planes x, y, z, w) = exp_map of `vectors` (3 planes x, y, z) [rad]. `count` is a multiple of kLanes
/// (aligned.h), planes are `stride` numbers apart; the arrays do not overlap. Scalar is float or double.
template <typename Scalar>
void exp_maps(int count, int stride, const Scalar* vectors, Scalar* rotations);

/// `vectors` (3 planes) = log_map of `rotations` (4 planes, any length but zero), near what `vectors` holds: of the
/// rotation vectors of a rotation the one that continues it, up to kFarthestAngle. Otherwise as above.
template <typename Scalar>
void log_maps_near(int count, int stride, const Scalar* rotations, Scalar* vectors);

/// `product` = a b, quaternions (4 planes each). Otherwise as above.
template <typename Scalar>
void multiply_rotations(int count, int stride, const Scalar* a, const Scalar* b, Scalar* product);

/// `turned` (3 planes) = `matrices` (9 planes, row by row) times `vectors` (3 planes). Otherwise as above.
template <typename Scalar>
void turn_vectors(int count, int stride, const Scalar* matrices, const Scalar* vectors, Scalar* turned);

/// Poses keep a joint's quaternion together (x, y, z, w), planes keep it apart. Joints from `num_joints` up to `stride`
/// become rotations by nothing.
template <typename Scalar>
void to_planes(int num_joints, int stride, const Scalar* quaternions, Scalar* planes);

}  // namespace strut::math
