// SPDX-License-Identifier: MIT
// What a person may move while a style is translated: how much of it, of what, where on the body, and of which model.
#pragma once

#include <array>
#include <vector>

#include <strut/motion/body_parts.h>

namespace strut {

/// Every factor scales the difference between input and translated motion: 0 gives the input, 1 the style, 1.5 half as
/// much again. Their product is what counts, at most kMostStrength.
struct TranslatorControls {
  double strength = 1.0;  ///< of everything, 0 to 1.5
  double pose = 1.0;      ///< of how the body is held on average (static), 0 to 1.5
  double movement = 1.0;  ///< of how it moves about that (temporal), speed and timing included, 0 to 1.5
  /// Of the joints of each part of the body (motion::BodyPart), 0 to 1.5. The root goes with the trunk.
  std::array<double, motion::kNumBodyParts> parts = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  /// Share of each model where several are blended, 0 or more, not all 0; only their ratios count. Empty: equal shares.
  std::vector<double> weights{};

  friend bool operator==(const TranslatorControls&, const TranslatorControls&) = default;
};

inline constexpr double kMostStrength = 1.5;

/// Throws InvalidArgument, naming the control, unless `controls` are in their ranges and fit `num_models`.
void check_controls(const TranslatorControls& controls, int num_models);

}  // namespace strut
