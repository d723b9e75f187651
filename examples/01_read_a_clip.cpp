// SPDX-License-Identifier: MIT
// Reads a BVH file and says what is in it: how motions are held, where joints are, what is guessed and reported.
//   01_read_a_clip [clip.bvh]     without a file it first makes one: walk.bvh, in the current folder
#include <cstdio>
#include <string>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>
#include <strut/motion/kinematics.h>

namespace {

std::string made_clip() {
  const strut::generate::Walk walk = strut::generate::generate_walk({.duration = 4.0, .speed = 1.2}, {});
  const strut::BvhLayout layout = strut::default_layout(walk.motion.skeleton());
  strut::write_bvh("walk.bvh", walk.motion, layout, strut::Overwrite::kAllow);
  return "walk.bvh";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string path = argc > 1 ? argv[1] : made_clip();

    // 1. Read. What had to be guessed (a BVH file does not state its unit) goes to `diagnostics`.
    strut::Diagnostics diagnostics;
    const strut::Motion motion = strut::read_bvh(path, {}, &diagnostics).motion;
    for (const auto& entry : diagnostics.entries()) std::printf("note: %s\n", entry.message.c_str());

    // 2. A motion is a skeleton, frames, and a rate: metres, Y up.
    std::printf("%s: %d frames at %g frames/s, %d joints\n", path.c_str(), motion.num_frames(), motion.frame_rate(),
                motion.skeleton().num_joints());

    // 3. Frames hold joints relative to their parents; forward kinematics puts them into the world.
    const int pelvis = motion.skeleton().pelvis();
    const auto positions = strut::motion::joint_positions_world(motion);
    const auto& first = positions.front()[static_cast<std::size_t>(pelvis)];
    const auto& last = positions.back()[static_cast<std::size_t>(pelvis)];
    std::printf("'%s' moves %.2f m in %.2f s\n", motion.skeleton().joint(pelvis).name.c_str(), (last - first).norm(),
                motion.duration());
    return 0;
  } catch (const strut::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
