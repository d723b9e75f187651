// SPDX-License-Identifier: MIT
// For the tests of footskate cleanup: a generated walk of which footplants are known, made to slide, and how far things
// moved.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <strut/generate/walker.h>
#include <strut/motion/kinematics.h>
#include <strut/postprocess/footskate.h>

namespace strut::postprocess {

/// Which feet are planted, per frame.
using Flags = std::vector<std::array<bool, 2>>;

inline std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The pelvis moves to and fro along the ground once a second, as where root and legs are predicted apart.
inline Motion sliding(const Motion& clip, double amplitude) {
  std::vector<Pose> frames = clip.frames();
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(t) / clip.frame_rate();
    frames[t].translations[0] += amplitude * Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
  }
  return {clip.shared_skeleton(), clip.frame_rate(), std::move(frames)};
}

struct Sliding {
  explicit Sliding(double amplitude, double frame_rate = 60.0, double speed = 1.3)
      : walk(generate::generate_walk({.duration = 5.0, .speed = speed}, {}, frame_rate)),
        clip(sliding(walk.motion, amplitude)),
        legs(motion::find_legs(clip).value()) {}

  [[nodiscard]] Motion cleaned(const FootskateOptions& options = {}) const {
    return clean_footskate(clip, legs, walk.footplants, options);
  }

  generate::Walk walk;
  Motion clip;
  motion::Legs legs;
};

/// Of any joint, in any frame [m].
inline double greatest_distance(const Motion& a, const Motion& b) {
  const auto x = motion::joint_positions_world(a), y = motion::joint_positions_world(b);
  double greatest = 0.0;
  for (std::size_t f = 0; f < x.size(); ++f) {
    for (std::size_t j = 0; j < x[f].size(); ++j) greatest = std::max(greatest, (x[f][j] - y[f][j]).norm());
  }
  return greatest;
}

inline Flags flags_of(const std::vector<motion::Footplant>& plants, int num_frames) {
  Flags flags(at(num_frames));
  for (const motion::Footplant& plant : plants) {
    for (int f = plant.begin; f < plant.end; ++f) flags[at(f)][at(plant.foot)] = true;
  }
  return flags;
}

/// As a motion: that rounds rotations to unit length once more, as it does in clean_footskate.
inline std::vector<Pose> streamed(FootskateCleaner& cleaner, const Motion& clip, const Flags& flags) {
  std::vector<Pose> cleaned;
  Pose pose;
  for (int f = 0; f < clip.num_frames(); ++f) {
    if (cleaner.push(clip.frame(f), flags[at(f)], pose)) cleaned.push_back(pose);
  }
  while (cleaner.flush(pose)) cleaned.push_back(pose);
  return Motion(clip.shared_skeleton(), clip.frame_rate(), std::move(cleaned)).frames();
}

inline std::vector<motion::Footplant> always(int num_frames) {
  return {{0, 0, num_frames}, {1, 0, num_frames}};
}

}  // namespace strut::postprocess
