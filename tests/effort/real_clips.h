// SPDX-License-Identifier: MIT
// Real clips as fragments are compared: read, in one feature space.
#pragma once

#include "support/data.h"

#include <string>
#include <vector>

#include <strut/effort/fragment_features.h>
#include <strut/io/bvh.h>
#include <strut/motion/legs.h>

namespace strut::effort::test {

/// A clip of the Bandai-Namco set, such as "walk_active_001".
inline Motion real_clip(const std::string& name) {
  return read_bvh(strut::test::real_data() + "/bandai-namco/dataset-2_" + name + ".bvh").motion;
}

/// The clips' features in the space of all of them, 24 dimensions.
inline std::vector<FrameMatrix> projected_clips(const std::vector<Motion>& clips) {
  const Eigen::Quaterniond upright = motion::upright_reference(clips);
  std::vector<FrameMatrix> features;
  for (const Motion& clip : clips) features.push_back(joint_features(clip, upright));
  const FeatureSpace space = fit_feature_space(features);
  for (FrameMatrix& clip : features) clip = project(space, clip);
  return features;
}

}  // namespace strut::effort::test
