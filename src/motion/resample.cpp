// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/motion/resample.h>

namespace strut::motion {
namespace {

// A frame is counted as reached when it misses by less than this share of a frame: 0.1 * 30 is not quite 3.
constexpr double kFrameRounding = 1e-9;

}  // namespace

Pose interpolate(const Pose& a, const Pose& b, double weight) {
  Pose pose;
  pose.rotations.reserve(a.rotations.size());
  pose.translations.reserve(a.translations.size());
  for (std::size_t j = 0; j < a.rotations.size(); ++j) {
    pose.rotations.push_back(a.rotations[j].slerp(weight, b.rotations[j]).normalized());
    pose.translations.emplace_back((1.0 - weight) * a.translations[j] + weight * b.translations[j]);
  }
  return pose;
}

Pose sample(const Motion& motion, double time) {
  if (motion.num_frames() == 0) throw InvalidArgument("motion", "at least one frame", "none");
  if (!std::isfinite(time)) throw InvalidArgument("time", "a finite number of seconds", std::to_string(time));
  const double position = std::clamp(time * motion.frame_rate(), 0.0, motion.num_frames() - 1.0);
  const int before = static_cast<int>(std::floor(position));
  const double weight = position - before;
  if (weight < kFrameRounding || before + 1 >= motion.num_frames()) return motion.frame(before);
  if (weight > 1.0 - kFrameRounding) return motion.frame(before + 1);
  return interpolate(motion.frame(before), motion.frame(before + 1), weight);
}

Motion resample(const Motion& motion, double frame_rate) {
  Motion result(motion.shared_skeleton(), frame_rate);  // checks the rate
  if (motion.num_frames() == 0 || frame_rate == motion.frame_rate()) {
    return {motion.shared_skeleton(), frame_rate, motion.frames()};
  }
  const double last = (motion.num_frames() - 1) / motion.frame_rate();
  const auto count = static_cast<std::size_t>(std::floor(last * frame_rate + kFrameRounding)) + 1;
  std::vector<Pose> frames;
  frames.reserve(count);
  for (std::size_t i = 0; i < count; ++i) frames.push_back(sample(motion, static_cast<double>(i) / frame_rate));
  return {motion.shared_skeleton(), frame_rate, std::move(frames)};
}

}  // namespace strut::motion
