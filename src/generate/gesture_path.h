// SPDX-License-Identifier: MIT
// A gesture before it has a body: the posture at every content time, and how fast the content time runs there.
#pragma once

#include <array>
#include <random>
#include <vector>

#include <strut/generate/gestures.h>

namespace strut::generate::detail {

/// A stroke and the place in it.
struct StrokePlace {
  std::size_t stroke = 0;
  double u = 0.0;  ///< 0 ... 1
};

/// What a style and a performer make of a content.
class GesturePath {
 public:
  GesturePath(const GestureContent& content, const GestureStyle& style, const Performer& who);

  /// The posture at content time `s` and motion time `t` [s]; s may lie outside the content.
  [[nodiscard]] Posture at(double s, double t) const;
  /// ds/dt, positive.
  [[nodiscard]] double pace(double s) const;
  [[nodiscard]] StrokePlace place(double s) const;
  [[nodiscard]] double duration() const noexcept { return times_.back(); }
  /// How far the right foot goes in a stroke [m].
  [[nodiscard]] double foot_way(std::size_t stroke) const;

 private:
  /// A sum of sines of time: what trembles or sways without meaning to.
  struct Wave {
    std::array<double, 3> frequency{}, phase{};
    [[nodiscard]] double at(double t) const;
  };

  void set_keys(const GestureContent& content, const GestureStyle& style, const Performer& who);
  void set_waves(const GestureStyle& style, std::mt19937_64& random);
  [[nodiscard]] double part_at(std::size_t part, double s) const;
  [[nodiscard]] double slope(std::size_t part, std::size_t key) const;

  std::vector<double> times_;      // of the keys, from 0: one more than strokes
  std::vector<Posture> postures_;  // at them
  std::vector<double> accents_, jitter_;
  double sudden_, bound_, strong_;  // as far as the performer shows them
  double tempo_, curvature_, tremor_, sway_;
  double ripple_frequency_ = 0.0, ripple_phase_ = 0.0;
  std::array<Wave, kNumPostureParts> trembling_, swaying_;
};

}  // namespace strut::generate::detail
