// SPDX-License-Identifier: MIT
#include "retarget.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/effort/effort_model.h>
#include <strut/motion/resample.h>

namespace strut::effort {
namespace {

constexpr int kFewestFrames = 4;  // that say how a body accelerates
constexpr double kUnitLength = 1e-6;

bool is_label(double value) {
  return !is_rated(value) || (value >= -1.0 && value <= 1.0);
}

void check_effort(const std::string& what, const EffortVector& effort) {
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    if (is_label(effort[factor])) continue;
    throw InvalidArgument(
        what, std::string("labels of ") + kFactorNames[static_cast<std::size_t>(factor)] + " between -1 and 1",
        std::to_string(effort[factor]));
  }
}

void check_fragment(const ModelFragment& fragment, const ModelFragment& first) {
  const Motion& motion = fragment.motion;
  if (motion.num_frames() < kFewestFrames) {
    throw InvalidArgument("fragment " + fragment.name, std::to_string(kFewestFrames) + " frames or more",
                          std::to_string(motion.num_frames()));
  }
  if (!is_same(motion.skeleton(), first.motion.skeleton()) || motion.frame_rate() != first.motion.frame_rate()) {
    throw InvalidArgument("fragment " + fragment.name, "the first fragment's skeleton and frame rate", "others");
  }
  check_effort("fragment " + fragment.name, fragment.effort);
}

/// The fragments of every group.
std::vector<std::vector<int>> groups_of(const std::vector<ModelFragment>& fragments) {
  std::vector<std::vector<int>> groups;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const int group = fragments[i].group;
    if (group < 0 || static_cast<std::size_t>(group) >= fragments.size()) {
      throw InvalidArgument("fragments", "groups from 0, without gaps", std::to_string(group));
    }
    groups.resize(std::max(groups.size(), static_cast<std::size_t>(group) + 1));
    groups[static_cast<std::size_t>(group)].push_back(static_cast<int>(i));
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].empty()) throw InvalidArgument("fragments", "groups without gaps", "nothing of " + std::to_string(g));
  }
  return groups;
}

void check_pairs(const EffortModelParts& parts) {
  const auto size = static_cast<int>(parts.fragments.size());
  for (const FragmentPair& pair : parts.pairs) {
    if (pair.first >= 0 && pair.first < pair.second && pair.second < size &&
        parts.fragments[static_cast<std::size_t>(pair.first)].group ==
            parts.fragments[static_cast<std::size_t>(pair.second)].group) {
      continue;
    }
    throw InvalidArgument("pairs", "two fragments of one group, ascending",
                          std::to_string(pair.first) + " and " + std::to_string(pair.second));
  }
}

/// Whether both say the same or nothing.
bool agree(double a, double b) {
  return is_rated(a) ? a == b : !is_rated(b);
}

void check_regression(const EffortModelParts& parts) {
  const EffortRegressionParts& learnt = parts.regression.parts();
  if (parts.regression.num_fragments() != static_cast<int>(parts.fragments.size())) {
    throw InvalidArgument("regression", std::to_string(parts.fragments.size()) + " fragments",
                          std::to_string(parts.regression.num_fragments()));
  }
  for (std::size_t i = 0; i < parts.fragments.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    bool same = learnt.group[row] == parts.fragments[i].group;
    for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
      same = same && agree(learnt.effort(row, factor), parts.fragments[i].effort[factor]);
    }
    if (!same) throw InvalidArgument("regression", "the fragments' groups and labels", "others");
  }
}

void check_scales(const EffortModelParts& parts) {
  if (!(std::abs(parts.upright.norm() - 1.0) < kUnitLength)) {
    throw InvalidArgument("upright", "a rotation", "one that is not of unit length");
  }
  if (!(parts.threshold > 0.0) || !std::isfinite(parts.threshold)) {
    throw InvalidArgument("threshold", "a positive number of metres", std::to_string(parts.threshold));
  }
  const FeatureSpace& space = parts.space;
  if (space.components.rows() != space.mean.size() || space.components.cols() < 1 || !space.components.allFinite() ||
      !space.mean.allFinite()) {
    throw InvalidArgument("space", "finite components of as many features as the mean has", "others");
  }
}

}  // namespace

FrameMatrix matching_features(const Motion& motion, const Eigen::Quaterniond& upright, const FeatureSpace& space) {
  return project(space, joint_features(motion::resample(motion, kFeatureRate), upright));
}

EffortModel::EffortModel(EffortModelParts parts) : parts_(std::move(parts)) {
  if (parts_.fragments.empty()) throw InvalidArgument("fragments", "at least one", "none");
  for (const ModelFragment& fragment : parts_.fragments) check_fragment(fragment, parts_.fragments.front());
  groups_ = groups_of(parts_.fragments);
  check_pairs(parts_);
  check_regression(parts_);
  if (parts_.estimator.numbers().groups.size() != groups_.size()) {
    throw InvalidArgument("estimator", std::to_string(groups_.size()) + " groups",
                          std::to_string(parts_.estimator.numbers().groups.size()));
  }
  check_scales(parts_);
  for (const ModelFragment& fragment : parts_.fragments) {
    features_.push_back(matching_features(fragment.motion, parts_.upright, parts_.space));
  }
}

}  // namespace strut::effort
