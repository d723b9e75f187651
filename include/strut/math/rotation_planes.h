// SPDX-License-Identifier: MIT
// Arithmetic on many rotations at once, kept in planes as in rotation_arrays.h.
#pragma once

namespace strut::math {

/// result = a b: products of quaternions (4 planes each, `stride` apart). `result` may be `a` or `b`.
template <typename Scalar>
inline void multiply_rotations(int count, int stride, const Scalar* a, const Scalar* b, Scalar* result) {
  for (int i = 0; i < count; ++i) {
    const Scalar ax = a[i], ay = a[i + stride], az = a[i + 2 * stride], aw = a[i + 3 * stride];
    const Scalar bx = b[i], by = b[i + stride], bz = b[i + 2 * stride], bw = b[i + 3 * stride];
    result[i] = aw * bx + ax * bw + ay * bz - az * by;
    result[i + stride] = aw * by - ax * bz + ay * bw + az * bx;
    result[i + 2 * stride] = aw * bz + ax * by - ay * bx + az * bw;
    result[i + 3 * stride] = aw * bw - ax * bx - ay * by - az * bz;
  }
}

/// result = matrix vector for every joint: `matrices` 9 planes row by row, `vectors` and `result` 3 planes. `result`
/// may be `vectors`.
template <typename Scalar>
inline void turn_vectors(int count, int stride, const Scalar* matrices, const Scalar* vectors, Scalar* result) {
  const Scalar* m = matrices;
  for (int i = 0; i < count; ++i) {
    const Scalar x = vectors[i], y = vectors[i + stride], z = vectors[i + 2 * stride];
    result[i] = m[i] * x + m[i + stride] * y + m[i + 2 * stride] * z;
    result[i + stride] = m[i + 3 * stride] * x + m[i + 4 * stride] * y + m[i + 5 * stride] * z;
    result[i + 2 * stride] = m[i + 6 * stride] * x + m[i + 7 * stride] * y + m[i + 8 * stride] * z;
  }
}

/// Poses keep a joint's quaternion together; planes keep it apart. Joints beyond `num_joints` up to `stride` become
/// rotations by nothing.
template <typename Scalar>
inline void to_planes(int num_joints, int stride, const Scalar* quaternions, Scalar* planes) {
  for (int i = 0; i < stride; ++i) {
    for (int part = 0; part < 4; ++part) {
      const Scalar nothing = part == 3 ? Scalar(1) : Scalar(0);
      planes[i + part * stride] = i < num_joints ? quaternions[4 * i + part] : nothing;
    }
  }
}

}  // namespace strut::math
