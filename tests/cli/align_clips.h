// SPDX-License-Identifier: MIT
// Clips for tests of strut align, and the program run on them.
#pragma once

#include "support/data.h"
#include "support/program.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>

namespace strut::test {

class AlignClips : public testing::Test {
 protected:
  /// A generated walk of `duration` [s] of content; its path.
  std::string clip(const std::string& name, double cadence, double duration = 2.0) {
    generate::WalkContent content;
    content.duration = duration;
    generate::WalkStyle style;
    style.cadence_scale = cadence;
    return write(name, generate::generate_walk(content, style, 30.0).motion);
  }
  /// The first `frames` of the clip at `path`; the path of the new one.
  std::string beginning(const std::string& name, const std::string& path, int frames) {
    return write(name, read_bvh(path).motion.slice(0, frames));
  }
  /// Its first frame, `frames` times.
  std::string still(const std::string& name, const std::string& path, int frames) {
    const Motion motion = read_bvh(path).motion;
    return write(name, Motion(motion.shared_skeleton(), motion.frame_rate(),
                              std::vector<Pose>(static_cast<std::size_t>(frames), motion.frames().front())));
  }
  std::string write(const std::string& name, const Motion& motion) {
    write_bvh(folder_.file(name), motion, default_layout(motion.skeleton()), Overwrite::kAllow);
    return folder_.file(name);
  }
  static ProgramResult align(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "align");
    return run_program(STRUT_PROGRAM, arguments);
  }
  TemporaryFolder folder_;
};

}  // namespace strut::test
