// SPDX-License-Identifier: MIT
#include "support/walks.h"

#include <memory>

#include <strut/generate/walker.h>
#include <strut/io/bvh.h>

namespace strut::test {

Motion short_walk(double limp, double seconds) {
  generate::WalkContent content;
  content.duration = seconds;
  generate::WalkStyle style;
  style.limp = limp;
  return generate::generate_walk(content, style, 30.0).motion;
}

Motion renamed(const Motion& motion, int joint, const std::string& name) {
  std::vector<Joint> joints = motion.skeleton().joints();
  joints[static_cast<std::size_t>(joint)].name = name;
  return {std::make_shared<const Skeleton>(std::move(joints)), motion.frame_rate(), motion.frames()};
}

Motion held(const Motion& motion, int num_frames) {
  const std::vector<Pose> frames(static_cast<std::size_t>(num_frames), motion.frame(0));
  return {motion.shared_skeleton(), motion.frame_rate(), frames};
}

void write_clip(const std::string& path, const Motion& motion) {
  write_bvh(path, motion, default_layout(motion.skeleton()), Overwrite::kAllow);
}

}  // namespace strut::test
