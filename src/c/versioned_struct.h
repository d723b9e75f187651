// SPDX-License-Identifier: MIT
// Structs that grow: their first field is struct_size, and whoever is older knows only a first part of their fields.
// Nothing here touches a byte beyond the size that the caller gave.
#pragma once

#include "c/status.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>

namespace strut::c {

/// Where the fields of a struct end [bytes]; `ends`, specialized per struct, the last of which is the struct's own.
template <typename Struct>
struct Fields;

/// A size above this is a number that was never set.
inline constexpr std::size_t kLargestStruct = 4096;

/// The bytes of the fields that lie wholly within `size`. Throws InvalidArgument, naming `name`, if not even
/// struct_size does, or if no struct is so large.
template <typename Struct>
std::size_t whole_fields(const char* name, std::size_t size) {
  constexpr auto& ends = Fields<Struct>::ends;
  static_assert(ends.back() == sizeof(Struct), "a field is missing, or there is padding at the end");
  if (size < ends.front() || size > kLargestStruct) {
    throw InvalidArgument(std::string(name) + ".struct_size", std::to_string(sizeof(Struct)), std::to_string(size));
  }
  return *(std::upper_bound(ends.begin(), ends.end(), size) - 1);
}

/// What the caller's struct says, `defaults` where it ends before. Throws InvalidArgument, naming `name`, if its size
/// is impossible or it says something in fields that are not known here.
template <typename Struct>
Struct taken(const char* name, const Struct* given, const Struct& defaults) {
  std::uint32_t size = 0;
  std::memcpy(&size, given, sizeof size);
  Struct result = defaults;
  std::memcpy(&result, given, whole_fields<Struct>(name, size));
  const auto* bytes = reinterpret_cast<const char*>(given);
  if (size > sizeof(Struct) && std::any_of(bytes + sizeof(Struct), bytes + size, [](char b) { return b != 0; })) {
    throw InvalidArgument(name, "only fields that strut " + std::string(strut_version()) + " knows", "others");
  }
  result.struct_size = sizeof(Struct);
  return result;
}

/// Writes `result` to the caller's struct of `size` bytes, as far as it goes, and zeros where it goes farther; its
/// struct_size becomes `size`.
template <typename Struct>
void give_sized(const char* name, Struct* wanted, std::size_t size, Struct result) {
  const std::size_t whole = whole_fields<Struct>(name, size);
  result.struct_size = static_cast<std::uint32_t>(size);
  auto* bytes = reinterpret_cast<char*>(wanted);
  std::memcpy(bytes, &result, whole);
  std::fill(bytes + whole, bytes + size, '\0');
}

/// The same where the caller's struct says its size.
template <typename Struct>
void give(const char* name, Struct* wanted, const Struct& result) {
  std::uint32_t size = 0;
  std::memcpy(&size, wanted, sizeof size);
  give_sized(name, wanted, size, result);
}

/// Where `field` of a struct ends.
#define STRUT_FIELD_END(Struct, field) (offsetof(Struct, field) + sizeof(Struct::field))

template <>
struct Fields<strut_axes> {
  static constexpr std::array ends = {STRUT_FIELD_END(strut_axes, struct_size),
                                      STRUT_FIELD_END(strut_axes, right),
                                      STRUT_FIELD_END(strut_axes, up),
                                      STRUT_FIELD_END(strut_axes, forward),
                                      STRUT_FIELD_END(strut_axes, quaternion_order),
                                      STRUT_FIELD_END(strut_axes, metres_per_unit)};
};

template <>
struct Fields<strut_model_info> {
  static constexpr std::array ends = {
      STRUT_FIELD_END(strut_model_info, struct_size), STRUT_FIELD_END(strut_model_info, num_joints),
      STRUT_FIELD_END(strut_model_info, frame_rate),  STRUT_FIELD_END(strut_model_info, num_dofs),
      STRUT_FIELD_END(strut_model_info, method),      STRUT_FIELD_END(strut_model_info, provenance)};
};

template <>
struct Fields<strut_joint> {
  static constexpr std::array ends = {STRUT_FIELD_END(strut_joint, struct_size), STRUT_FIELD_END(strut_joint, parent),
                                      STRUT_FIELD_END(strut_joint, name), STRUT_FIELD_END(strut_joint, offset),
                                      STRUT_FIELD_END(strut_joint, part)};
};

template <>
struct Fields<strut_controls> {
  static constexpr std::array ends = {
      STRUT_FIELD_END(strut_controls, struct_size), STRUT_FIELD_END(strut_controls, num_weights),
      STRUT_FIELD_END(strut_controls, strength),    STRUT_FIELD_END(strut_controls, pose),
      STRUT_FIELD_END(strut_controls, movement),    STRUT_FIELD_END(strut_controls, parts),
      STRUT_FIELD_END(strut_controls, weights)};
};

template <>
struct Fields<strut_feet> {
  static constexpr std::array ends = {
      STRUT_FIELD_END(strut_feet, struct_size),    STRUT_FIELD_END(strut_feet, look_ahead),
      STRUT_FIELD_END(strut_feet, shortest_plant), STRUT_FIELD_END(strut_feet, shortest_gap),
      STRUT_FIELD_END(strut_feet, max_stretch),    STRUT_FIELD_END(strut_feet, reach),
      STRUT_FIELD_END(strut_feet, body_follows),   STRUT_FIELD_END(strut_feet, max_drag)};
};

// NOLINTBEGIN(bugprone-sizeof-expression): it is the pointers' own size that is meant
template <>
struct Fields<strut_translator_options> {
  static constexpr std::array ends = {
      STRUT_FIELD_END(strut_translator_options, struct_size), STRUT_FIELD_END(strut_translator_options, generalize),
      STRUT_FIELD_END(strut_translator_options, confidence),  STRUT_FIELD_END(strut_translator_options, preference),
      STRUT_FIELD_END(strut_translator_options, fade),        STRUT_FIELD_END(strut_translator_options, glide),
      STRUT_FIELD_END(strut_translator_options, controls),    STRUT_FIELD_END(strut_translator_options, axes),
      STRUT_FIELD_END(strut_translator_options, feet)};
};
// NOLINTEND(bugprone-sizeof-expression)

}  // namespace strut::c
