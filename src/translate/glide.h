// SPDX-License-Identifier: MIT
// Controls that are moved while a stream runs arrive without a jump: each follows its target through two low-pass
// filters in a row, so that neither it nor its speed jumps, and it never overshoots.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <strut/math/low_pass.h>

namespace strut::translate {

/// A few numbers on their way to where they were told to go.
class Glide {
 public:
  /// `reach` [frames]: of each filter; 0 jumps. `start`: where the numbers are at first.
  Glide(std::vector<double> start, double reach)
      : gain_(math::low_pass_gain(reach)), target_(start), middle_(start), value_(start) {}

  /// Where to go: as many numbers. No allocation.
  template <typename Numbers>
  void go_to(const Numbers& target) {
    std::copy(target.begin(), target.end(), target_.begin());
    has_arrived_ = false;
  }
  /// Is there at once.
  void arrive() {
    middle_ = value_ = target_;
    has_arrived_ = true;
  }
  /// One frame; true if anything moved.
  bool advance() {
    if (has_arrived_) return false;
    double farthest = 0.0;
    for (std::size_t i = 0; i < value_.size(); ++i) {
      middle_[i] += gain_ * (target_[i] - middle_[i]);
      value_[i] += gain_ * (middle_[i] - value_[i]);
      farthest = std::max({farthest, std::abs(target_[i] - value_[i]), std::abs(target_[i] - middle_[i])});
    }
    constexpr double kThere = 1e-7;  // of a strength: far below what could be seen
    if (farthest < kThere) arrive();
    return true;
  }
  [[nodiscard]] const std::vector<double>& value() const noexcept { return value_; }

  /// As PoseEncoder::visit_state.
  template <typename Visit>
  void visit_state(Visit&& visit) {
    visit(&has_arrived_, 1);
    for (std::vector<double>* numbers : {&target_, &middle_, &value_}) visit(numbers->data(), numbers->size());
  }

 private:
  double gain_;
  std::vector<double> target_, middle_, value_;
  bool has_arrived_ = true;
};

}  // namespace strut::translate
