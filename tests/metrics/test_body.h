// SPDX-License-Identifier: MIT
// A body made of nothing but joint positions, for hand-computed metrics: facing +Z, one metre of leg, arms out.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <strut/motion/motion.h>

namespace strut::metrics::test {

enum TestJoint { kPelvis, kChest, kHead, kHandL, kHandR, kHipL, kKneeL, kAnkleL, kToeL, kHipR, kKneeR, kAnkleR, kToeR };
inline constexpr int kNumJoints = 13;

inline std::shared_ptr<const Skeleton> test_skeleton() {
  static const auto skeleton = std::make_shared<const Skeleton>(std::vector<Joint>{
      {"pelvis", -1, {0, 1.0, 0}},
      {"chest", kPelvis, {0, 0.4, 0}},
      {"head", kChest, {0, 0.3, 0}},
      {"hand_l", kChest, {0.7, 0, 0}},
      {"hand_r", kChest, {-0.7, 0, 0}},
      {"hip_l", kPelvis, {0.1, -0.05, 0}},
      {"knee_l", kHipL, {0, -0.45, 0}},
      {"ankle_l", kKneeL, {0, -0.42, 0}},
      {"toe_l", kAnkleL, {0, -0.06, 0.12}},
      {"hip_r", kPelvis, {-0.1, -0.05, 0}},
      {"knee_r", kHipR, {0, -0.45, 0}},
      {"ankle_r", kKneeR, {0, -0.42, 0}},
      {"toe_r", kAnkleR, {0, -0.06, 0.12}},
  });
  return skeleton;
}

/// `frames` frames at `rate` of the standing body; `move(pose, seconds)` may shift joints (translations, in the
/// parent's frame; nothing is rotated, so all frames are parallel to the world's).
inline Motion test_motion(int frames, double rate, const std::function<void(Pose&, double)>& move = {}) {
  std::vector<Pose> poses;
  for (int i = 0; i < frames; ++i) {
    poses.push_back(rest_pose(*test_skeleton()));
    if (move) move(poses.back(), i / rate);
  }
  return {test_skeleton(), rate, std::move(poses)};
}

}  // namespace strut::metrics::test
