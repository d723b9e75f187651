// SPDX-License-Identifier: MIT
// Reads a clip and aligns two signals: touches the learning half, which brings oneTBB along.
#include <cmath>
#include <cstdio>

#include <strut/align/iterative_motion_warping.h>
#include <strut/io/bvh.h>

namespace {

constexpr const char* kClip =
    "HIERARCHY\nROOT hip\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n"
    "MOTION\nFrames: 2\nFrame Time: 0.04\n0 0 0\n0 0 1\n";

}  // namespace

int main() {
  const strut::BvhClip clip = strut::parse_bvh(kClip, "clip.bvh");
  strut::FrameMatrix wave(40, 1);
  for (int t = 0; t < 40; ++t) wave(t, 0) = std::sin(0.3 * t);
  const auto aligned = strut::align::iterative_motion_warping(wave, wave);
  std::printf("%d frames, %zu rounds\n", clip.motion.num_frames(), aligned.objective.size());
  return clip.motion.num_frames() == 2 ? 0 : 1;
}
