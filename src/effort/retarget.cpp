// SPDX-License-Identifier: MIT
#include "retarget.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <strut/core/error.h>
#include <strut/motion/legs.h>

namespace strut::effort {

double leg_length(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  double length = 0.0;
  if (const auto legs = motion::find_legs(motion)) {
    for (const int foot : {0, 1}) {
      length +=
          skeleton.joint(legs->foot(foot).knee).offset.norm() + skeleton.joint(legs->foot(foot).ankle).offset.norm();
    }
    return length;
  }
  for (int j = 1; j < skeleton.num_joints(); ++j) length += skeleton.joint(j).offset.norm();
  return length;
}

bool is_same(const Skeleton& a, const Skeleton& b) {
  if (&a == &b) return true;
  const auto same_joint = [](const Joint& x, const Joint& y) {
    return x.name == y.name && x.parent == y.parent && x.offset == y.offset && x.has_end_site == y.has_end_site &&
           x.end_site == y.end_site;
  };
  return std::equal(a.joints().begin(), a.joints().end(), b.joints().begin(), b.joints().end(), same_joint);
}

Motion on_skeleton(const Motion& motion, const std::shared_ptr<const Skeleton>& skeleton, double scale) {
  if (motion.shared_skeleton() == skeleton && scale == 1.0) return motion;
  const Skeleton& here = motion.skeleton();
  if (const std::string mismatch = describe_mismatch(here, *skeleton); !mismatch.empty()) {
    throw SkeletonMismatch(mismatch);
  }
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    pose.translations.front() *= scale;
    for (std::size_t j = 1; j < pose.translations.size(); ++j) {
      const Eigen::Vector3d stretch = pose.translations[j] - here.joints()[j].offset;
      pose.translations[j] = skeleton->joints()[j].offset + scale * stretch;
    }
  }
  return {skeleton, motion.frame_rate(), std::move(frames)};
}

}  // namespace strut::effort
