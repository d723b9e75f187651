// SPDX-License-Identifier: MIT
// Everything that putting an Effort on a motion needs: the labelled fragments, which of them can be blended, and how
// their labels carry over to blends. Made by learn_effort, kept in a .struteffort file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/effort/effort.h>
#include <strut/effort/effort_estimate.h>
#include <strut/effort/effort_regression.h>
#include <strut/effort/fragment_features.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// A fragment as a model holds it.
struct ModelFragment {
  std::string name;     ///< clip and frames it is from, for reports
  int group = 0;        ///< of like content, from 0
  Motion motion;        ///< on the model's skeleton, at the model's frame rate
  EffortVector effort;  ///< mean of the raters' labels; kNotRated where a factor was left out
};

/// What a model is made of.
struct EffortModelParts {
  Eigen::Quaterniond upright;            ///< motion::upright_reference of all fragments
  FeatureSpace space;                    ///< what fragments are compared in
  std::vector<ModelFragment> fragments;  ///< all on one skeleton, at one rate
  std::vector<FragmentPair> pairs;       ///< that can be blended: accepted, of one group, first < second
  EffortRegression regression;           ///< how labels carry over to blends of the fragments
  KinematicEstimator estimator;          ///< how what a movement looks like is labelled
  double threshold = 0.0;                ///< mean distance below which content is alike [m], > 0
  bool are_estimates = false;            ///< whether the labels are the program's estimates instead of people's
  std::string provenance = "{}";         ///< JSON: where all is from, raters, options, figures of validation
};

/// Immutable; const calls are thread-safe.
class EffortModel {
 public:
  /// Throws InvalidArgument if there is no fragment, their skeletons (joints, bone lengths) or rates differ, a fragment
  /// has fewer than 4 frames, groups are not 0, 1, ... without gaps, a label is outside [-1, 1], a pair names no two
  /// fragments of one group, the regression is of other fragments, groups or labels, the
  /// estimator of another number of groups, the feature space is of another
  /// skeleton, or a number is not finite. Cost: features of all frames.
  explicit EffortModel(EffortModelParts parts);

  [[nodiscard]] const EffortModelParts& parts() const noexcept { return parts_; }
  [[nodiscard]] const std::vector<ModelFragment>& fragments() const noexcept { return parts_.fragments; }
  [[nodiscard]] const ModelFragment& fragment(int index) const {
    return parts_.fragments.at(static_cast<std::size_t>(index));
  }
  [[nodiscard]] const std::shared_ptr<const Skeleton>& shared_skeleton() const noexcept {
    return parts_.fragments.front().motion.shared_skeleton();
  }
  [[nodiscard]] const Skeleton& skeleton() const noexcept { return *shared_skeleton(); }
  [[nodiscard]] double frame_rate() const noexcept { return parts_.fragments.front().motion.frame_rate(); }
  [[nodiscard]] int num_groups() const noexcept { return static_cast<int>(groups_.size()); }
  /// The fragments of a group, ascending.
  [[nodiscard]] const std::vector<int>& group(int index) const { return groups_.at(static_cast<std::size_t>(index)); }
  /// A fragment as matching sees it, at kFeatureRate (frames x dimensions of the space).
  [[nodiscard]] const FrameMatrix& features(int fragment) const {
    return features_.at(static_cast<std::size_t>(fragment));
  }

 private:
  EffortModelParts parts_;
  std::vector<std::vector<int>> groups_;
  std::vector<FrameMatrix> features_;
};

/// A motion as matching sees it: at kFeatureRate, in `space` (frames x dimensions).
/// Throws InvalidArgument if the space is of another skeleton.
FrameMatrix matching_features(const Motion& motion, const Eigen::Quaterniond& upright, const FeatureSpace& space);

}  // namespace strut::effort
