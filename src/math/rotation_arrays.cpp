// SPDX-License-Identifier: MIT
#include "math/vector_kernels.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include <strut/math/aligned.h>
#include <strut/math/rotation_arrays.h>

namespace strut::math {
namespace {

template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// `shortest` with the whole turns added that bring it nearest to `previous`, unless that is farther than kFarthest.
template <typename Scalar>
Vector3<Scalar> unwound(const Vector3<Scalar>& shortest, const Vector3<Scalar>& previous) {
  constexpr Scalar kTurn = Scalar(2) * std::numbers::pi_v<Scalar>;
  const Scalar angle = shortest.norm();
  if (angle == Scalar(0)) return shortest;
  const Vector3<Scalar> axis = shortest / angle;
  const Scalar near = angle + kTurn * std::round((axis.dot(previous) - angle) / kTurn);
  return std::abs(near) > kFarthestAngle<Scalar> ? shortest : Vector3<Scalar>(axis * near);
}

}  // namespace

template <typename Scalar>
void exp_maps(int count, int stride, const Scalar* vectors, Scalar* rotations) {
  vector_kernels<Scalar>().exp_maps(count, stride, vectors, rotations);
}

template <typename Scalar>
void log_maps_near(int count, int stride, const Scalar* rotations, Scalar* vectors) {
  std::array<Scalar, 3 * kLanes> shortest;
  std::array<Scalar, 4 * kLanes> some;
  for (int first = 0; first < count; first += kLanes) {
    for (int plane = 0; plane < 4; ++plane) {
      for (int lane = 0; lane < kLanes; ++lane)
        some[static_cast<std::size_t>(plane * kLanes + lane)] = rotations[plane * stride + first + lane];
    }
    vector_kernels<Scalar>().log_maps(kLanes, kLanes, some.data(), shortest.data());
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      const Vector3<Scalar> found(shortest[at], shortest[at + kLanes], shortest[at + 2 * kLanes]);
      Scalar* kept = vectors + first + lane;
      const Vector3<Scalar> previous(kept[0], kept[stride], kept[2 * stride]);
      // Vectors nearer to each other than half a turn are on one branch.
      constexpr Scalar kHalfTurn = std::numbers::pi_v<Scalar>;
      const bool continues = (found - previous).squaredNorm() < kHalfTurn * kHalfTurn;
      const Vector3<Scalar> near = continues ? found : unwound(found, previous);
      kept[0] = near.x();
      kept[stride] = near.y();
      kept[2 * stride] = near.z();
    }
  }
}

template <typename Scalar>
void multiply_rotations(int count, int stride, const Scalar* a, const Scalar* b, Scalar* product) {
  vector_kernels<Scalar>().multiply_rotations(count, stride, a, b, product);
}

template <typename Scalar>
void turn_vectors(int count, int stride, const Scalar* matrices, const Scalar* vectors, Scalar* turned) {
  vector_kernels<Scalar>().turn_vectors(count, stride, matrices, vectors, turned);
}

template <typename Scalar>
void to_planes(int num_joints, int stride, const Scalar* quaternions, Scalar* planes) {
  for (int i = 0; i < num_joints; ++i) {
    for (int part = 0; part < 4; ++part) planes[i + part * stride] = quaternions[4 * i + part];
  }
  for (int i = num_joints; i < stride; ++i) {
    for (int part = 0; part < 4; ++part) planes[i + part * stride] = part == 3 ? Scalar(1) : Scalar(0);
  }
}

template void exp_maps(int, int, const float*, float*);
template void exp_maps(int, int, const double*, double*);
template void log_maps_near(int, int, const float*, float*);
template void log_maps_near(int, int, const double*, double*);
template void multiply_rotations(int, int, const float*, const float*, float*);
template void multiply_rotations(int, int, const double*, const double*, double*);
template void turn_vectors(int, int, const float*, const float*, float*);
template void turn_vectors(int, int, const double*, const double*, double*);
template void to_planes(int, int, const float*, float*);
template void to_planes(int, int, const double*, double*);

}  // namespace strut::math
