// SPDX-License-Identifier: MIT
// What the study of the Effort engine is made on: fragments whose content and performer are known, all on one body.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/math/frame_matrix.h>
#include <strut/motion/motion.h>

namespace strut::study {

struct StudyFragment {
  Motion motion;
  int group = 0;      ///< of like content
  int performer = 0;  ///< who can be held out
};

/// Fragments, and what the engine and the raters see of them.
struct FragmentSet {
  std::vector<std::string> contents;  ///< name of each group
  std::vector<StudyFragment> fragments;
  int num_performers = 0;
  Eigen::Quaterniond upright = Eigen::Quaterniond::Identity();
  std::vector<FrameMatrix> features;  ///< joint_features of each fragment, at kFeatureRate
  std::vector<Eigen::VectorXd> cues;  ///< movement_cues of each fragment

  [[nodiscard]] std::vector<int> group(int index) const;
};

/// The generator's standard set, on a body of 1.75 m: 8 contents by 5 performers by 6 settings.
FragmentSet gesture_set(std::uint64_t seed);

/// Takes 001 to 012 of the clips in `folder`: three gestures, a walk and a run in four styles; one fragment per clip.
/// Takes 1 to 8 and 9 to 12 count as two performers.
FragmentSet real_set(const std::string& folder);

}  // namespace strut::study
