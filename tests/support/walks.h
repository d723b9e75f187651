// SPDX-License-Identifier: MIT
// Small clips for tests of the program: a generated walk, as a BVH file, and ways to spoil it.
#pragma once

#include <string>
#include <vector>

#include <strut/motion/motion.h>

namespace strut::test {

/// A straight walk at 30 frames/s, `limp` from 0 to 1, of `seconds`.
Motion short_walk(double limp, double seconds = 3.0);

/// `motion` with its joint `joint` called `name`.
Motion renamed(const Motion& motion, int joint, const std::string& name);

/// The first frame of `motion`, held.
Motion held(const Motion& motion, int num_frames);

/// Writes a clip as BVH in centimetres.
void write_clip(const std::string& path, const Motion& motion);

}  // namespace strut::test
