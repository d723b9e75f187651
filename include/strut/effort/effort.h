// SPDX-License-Identifier: MIT
// The vocabulary of the Effort engine: Laban's Effort factors as numbers, and what a rater says of one movement
// (Torresani, Hackney, Bregler 2006; Hackney 2000).
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace strut::effort {

/// Laban's Effort factors. Each runs from -1 to 1 between two poles; 0 is neutral.
enum Factor {
  kFlow,    ///< free (-1) ... bound (1)
  kWeight,  ///< light ... strong
  kTime,    ///< sustained ... sudden
  kSpace,   ///< indirect ... direct: raters may label it; nothing here predicts it
};

inline constexpr int kNumFactors = 4;           ///< that can be labelled
inline constexpr int kNumPredictedFactors = 3;  ///< Flow, Weight, Time: what is learnt and asked for

/// "flow", "weight", "time", "space" in the order of Factor: as columns and options are called.
inline constexpr std::array<const char*, kNumFactors> kFactorNames = {"flow", "weight", "time", "space"};
/// The poles at -1 and at 1, in the order of Factor.
inline constexpr std::array<std::array<const char*, 2>, kNumFactors> kFactorPoles = {
    {{"free", "bound"}, {"light", "strong"}, {"sustained", "sudden"}, {"indirect", "direct"}}};

/// Flow, Weight and Time of one movement, in that order: labels lie in [-1, 1], predictions may lie a little outside.
using EffortVector = Eigen::Vector3d;

/// How far a blend of two fragments may go: 0 is the first, 1 the second, what lies outside exaggerates.
inline constexpr double kLeastAlpha = -2.0;
inline constexpr double kLargestAlpha = 3.0;

/// What stands where a factor was left out or is not known.
inline constexpr double kNotRated = std::numeric_limits<double>::quiet_NaN();

/// What one rater said of one movement: all four factors, kNotRated where one was left out.
using Rating = Eigen::Vector4d;

/// Whether a number is a label rather than kNotRated.
inline bool is_rated(double value) {
  return !std::isnan(value);
}

}  // namespace strut::effort
