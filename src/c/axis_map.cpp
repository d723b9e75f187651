// SPDX-License-Identifier: MIT
#include "c/axis_map.h"

#include "c/versioned_struct.h"

#include <cmath>
#include <cstdlib>
#include <string>

namespace strut::c {
namespace {

constexpr float kSmallestUnit = 1e-6F, kLargestUnit = 1e6F;  // [m]

std::size_t coordinate_of(const char* name, int axis) {
  const int number = axis < 0 ? -axis : axis;
  if (axis < -3 || axis > 3 || number == 0) {
    throw InvalidArgument(name, "one of STRUT_AXIS_...", std::to_string(axis));
  }
  return static_cast<std::size_t>(number - 1);
}

float sign_of(int axis) {
  return axis < 0 ? -1.0F : 1.0F;
}

/// The sign of the permutation that takes 0, 1, 2 to `source`.
float parity(const std::array<std::size_t, 3>& source) {
  return (source[0] + 1) % 3 == source[1] ? 1.0F : -1.0F;
}

void check_unit(float metres) {
  if (metres >= kSmallestUnit && metres <= kLargestUnit) return;
  throw InvalidArgument("axes.metres_per_unit", "a number from 1e-6 to 1e6", std::to_string(metres));
}

}  // namespace

strut_axes default_axes() {
  return axes_of_convention(STRUT_CONVENTION_STRUT);
}

strut_axes axes_of_convention(int convention) {
  constexpr std::uint32_t kSize = sizeof(strut_axes);
  constexpr int kXyzw = STRUT_QUATERNION_XYZW;
  switch (convention) {
    case STRUT_CONVENTION_STRUT:
    case STRUT_CONVENTION_GLTF:
      return {kSize, STRUT_AXIS_NEGATIVE_X, STRUT_AXIS_POSITIVE_Y, STRUT_AXIS_POSITIVE_Z, kXyzw, 1.0F};
    case STRUT_CONVENTION_UNITY:
      return {kSize, STRUT_AXIS_POSITIVE_X, STRUT_AXIS_POSITIVE_Y, STRUT_AXIS_POSITIVE_Z, kXyzw, 1.0F};
    case STRUT_CONVENTION_UNREAL:
      return {kSize, STRUT_AXIS_POSITIVE_Y, STRUT_AXIS_POSITIVE_Z, STRUT_AXIS_POSITIVE_X, kXyzw, 0.01F};
    case STRUT_CONVENTION_BLENDER:
      return {kSize, STRUT_AXIS_NEGATIVE_X, STRUT_AXIS_POSITIVE_Z, STRUT_AXIS_NEGATIVE_Y, kXyzw, 1.0F};
    default:
      throw InvalidArgument("convention", "one of STRUT_CONVENTION_...", std::to_string(convention));
  }
}

strut_axes axes_or_default(const char* name, const strut_axes* given) {
  return given == nullptr ? default_axes() : taken(name, given, default_axes());
}

AxisMap::AxisMap(const strut_axes& axes)
    : source_{coordinate_of("axes.right", axes.right), coordinate_of("axes.up", axes.up),
              coordinate_of("axes.forward", axes.forward)},
      // strut's +X points to the left.
      sign_{-sign_of(axes.right), sign_of(axes.up), sign_of(axes.forward)},
      metres_(axes.metres_per_unit),
      units_(1.0F / axes.metres_per_unit) {
  check_unit(axes.metres_per_unit);
  if (source_[0] == source_[1] || source_[1] == source_[2] || source_[2] == source_[0]) {
    throw InvalidArgument("axes", "three different axes", "one of them twice");
  }
  if (axes.quaternion_order != STRUT_QUATERNION_XYZW && axes.quaternion_order != STRUT_QUATERNION_WXYZ) {
    throw InvalidArgument("axes.quaternion_order", "one of STRUT_QUATERNION_...",
                          std::to_string(axes.quaternion_order));
  }
  const bool w_first = axes.quaternion_order == STRUT_QUATERNION_WXYZ;
  vector_at_ = w_first ? 1 : 0;
  w_at_ = w_first ? 0 : 3;
  handedness_ = parity(source_) * sign_[0] * sign_[1] * sign_[2];
  is_identity_ = source_ == std::array<std::size_t, 3>{0, 1, 2} && sign_ == std::array{1.0F, 1.0F, 1.0F} && !w_first &&
                 metres_ == 1.0F;
}

void AxisMap::rotation_to_strut(const float* from, float* to) const noexcept {
  const std::array<float, 3> v = {from[vector_at_], from[vector_at_ + 1], from[vector_at_ + 2]};
  const float w = from[w_at_];
  for (std::size_t i = 0; i < 3; ++i) to[i] = handedness_ * sign_[i] * v[source_[i]];
  to[3] = w;
}

void AxisMap::rotation_from_strut(const float* from, float* to) const noexcept {
  const std::array<float, 4> q = {from[0], from[1], from[2], from[3]};
  for (std::size_t i = 0; i < 3; ++i) to[vector_at_ + source_[i]] = handedness_ * sign_[i] * q[i];
  to[w_at_] = q[3];
}

void AxisMap::translation_to_strut(const float* from, float* to) const noexcept {
  const std::array<float, 3> t = {from[0], from[1], from[2]};
  for (std::size_t i = 0; i < 3; ++i) to[i] = metres_ * sign_[i] * t[source_[i]];
}

void AxisMap::translation_from_strut(const float* from, float* to) const noexcept {
  const std::array<float, 3> t = {from[0], from[1], from[2]};
  for (std::size_t i = 0; i < 3; ++i) to[source_[i]] = units_ * sign_[i] * t[i];
}

}  // namespace strut::c

strut_status strut_axes_init(strut_axes* axes, size_t struct_size, int32_t convention) {
  using namespace strut::c;
  return guarded([&] {
    give_sized("axes", &required("axes", axes), struct_size, axes_of_convention(convention));
    return STRUT_OK;
  });
}
