// SPDX-License-Identifier: MIT
// Poses from an engine's axes, units and order of numbers to strut's and back: a change of basis of every joint's
// transform. With B the matrix that takes the engine's coordinates to strut's (a permutation with signs), a translation
// t becomes B t in metres and a rotation R becomes B R B^T: of its quaternion, w stays and the rest, an axial vector,
// becomes det(B) B v.
#pragma once

#include <array>
#include <cstddef>

#include <strut/c/strut.h>

namespace strut::c {

/// strut's own convention.
strut_axes default_axes();

/// One of the conventions (STRUT_CONVENTION_...). Throws InvalidArgument if there is no such one.
strut_axes axes_of_convention(int convention);

/// What `given` says, strut's own where it is NULL or ends before. Throws InvalidArgument if its size is impossible.
strut_axes axes_or_default(const char* name, const strut_axes* given);

/// A change of basis between an engine's convention and strut's. No call allocates.
class AxisMap {
 public:
  /// Throws InvalidArgument, naming the field, unless the three axes are three of the six and differ, the order is one
  /// of the two, and the unit is from a micrometre to a thousand kilometres.
  explicit AxisMap(const strut_axes& axes);

  /// Whether nothing changes.
  [[nodiscard]] bool is_identity() const noexcept { return is_identity_; }

  /// Four numbers of a quaternion, x, y, z, w on strut's side; three of a translation, metres there. `to` may be
  /// `from`.
  void rotation_to_strut(const float* from, float* to) const noexcept;
  void rotation_from_strut(const float* from, float* to) const noexcept;
  void translation_to_strut(const float* from, float* to) const noexcept;
  void translation_from_strut(const float* from, float* to) const noexcept;

 private:
  std::array<std::size_t, 3> source_{};  // of strut's x, y, z: which of the engine's coordinates
  std::array<float, 3> sign_{};          // and its sign
  float handedness_ = 1.0F;              // det(B)
  float metres_ = 1.0F, units_ = 1.0F;   // per unit, per metre
  std::size_t vector_at_ = 0, w_at_ = 3;
  bool is_identity_ = true;
};

}  // namespace strut::c
