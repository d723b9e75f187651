// SPDX-License-Identifier: MIT
// A quantity that is told over time by a few keys: what a walk is asked to do.
#pragma once

#include <vector>

namespace strut::generate {

/// A value at a time.
struct ScheduleKey {
  double time = 0.0;   ///< [s]
  double value = 0.0;  ///< in the unit of what is scheduled
};

/// Straight lines between keys, constant before the first and after the last.
class Schedule {
 public:
  /// The same value at all times. Implicit, so that a number stands for a schedule: `content.speed = 1.2`.
  Schedule(double value) : keys_{{0.0, value}} {}  // NOLINT(google-explicit-constructor)
  /// Throws InvalidArgument if `keys` is empty, their times do not ascend strictly, or a number is not finite.
  explicit Schedule(std::vector<ScheduleKey> keys);

  /// The value at `time` [s].
  [[nodiscard]] double at(double time) const;
  /// The exact mean over [begin, end] [s]; the value at `begin` if the interval is empty. Cost O(keys).
  [[nodiscard]] double mean(double begin, double end) const;
  [[nodiscard]] const std::vector<ScheduleKey>& keys() const noexcept { return keys_; }

 private:
  std::vector<ScheduleKey> keys_;
};

}  // namespace strut::generate
