// SPDX-License-Identifier: MIT
// The Effort wanted over time: what sliders say, constant or moved while the motion runs.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <strut/effort/effort.h>
#include <strut/math/smooth_curve.h>

namespace strut::effort {

/// What is wanted at a time.
struct EffortKey {
  double time = 0.0;    ///< [s]
  EffortVector effort;  ///< in [-1, 1]; kNotRated: this factor was not asked for
};

/// Between keys each factor changes smoothly and never leaves the range of two neighbours; before the first and after
/// the last key it stays.
class EffortCurve {
 public:
  /// The same at all times. Throws as the other.
  explicit EffortCurve(const EffortVector& effort);
  /// Throws InvalidArgument if there is no key, times do not ascend strictly, a value is outside [-1, 1], a factor is
  /// asked for by some keys only, or none is asked for.
  explicit EffortCurve(std::vector<EffortKey> keys);

  /// kNotRated for a factor that was not asked for.
  [[nodiscard]] EffortVector at(double time) const;
  [[nodiscard]] bool asks_for(Factor factor) const { return is_rated(keys_.front().effort[factor]); }

 private:
  std::vector<EffortKey> keys_;
  std::array<std::optional<math::SmoothCurve>, kNumPredictedFactors> curves_;  // of factors asked for, if keys change
};

}  // namespace strut::effort
