// SPDX-License-Identifier: MIT
// Examples to learn from, made by the walker: walks of one content in a relaxed style and limping.
#pragma once

#include <cstdint>
#include <vector>

#include <strut/generate/walker.h>
#include <strut/learn/learn_style.h>

namespace strut::test {

constexpr double kExampleRate = 30.0;

inline generate::WalkContent content(double speed, double turn_rate, double duration = 6.0) {
  return {.duration = duration, .speed = speed, .turn_rate = turn_rate};
}

inline generate::WalkStyle limping(std::uint64_t seed) {
  return {.cadence_scale = 0.85, .crouch = 0.05, .torso_lean = 0.2, .limp = 0.8, .seed = seed};
}

struct Clips {
  std::vector<Motion> inputs, outputs;
  std::vector<learn::ClipPair> pairs;
};

/// A clip of each style per content, and the pairs that are found in them.
inline Clips make_clips(const std::vector<generate::WalkContent>& contents, double rate = kExampleRate) {
  Clips clips;
  std::uint64_t seed = 1;
  for (const generate::WalkContent& walk : contents) {
    clips.inputs.push_back(generate::generate_walk(walk, {.seed = seed++}, rate).motion);
    clips.outputs.push_back(generate::generate_walk(walk, limping(seed++), rate).motion);
  }
  clips.pairs = learn::find_pairs(clips.inputs, clips.outputs).pairs;
  return clips;
}

/// Seven contents: speeds, and turns to both sides.
inline const Clips& varied_clips() {
  static const Clips clips = make_clips({content(1.0, 0.0), content(1.3, 0.0), content(1.5, 0.0), content(1.2, 0.4),
                                         content(1.2, -0.4), content(1.4, 0.2), content(1.4, -0.2)});
  return clips;
}

inline LearntStyle learn_from(const Clips& clips, const LearnOptions& options = {},
                              Diagnostics* diagnostics = nullptr) {
  return learn_style(clips.inputs, clips.outputs, clips.pairs, options, {}, diagnostics);
}

}  // namespace strut::test
