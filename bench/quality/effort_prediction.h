// SPDX-License-Identifier: MIT
// How well a rater's labels of blends are predicted when fragments, contents or performers are held out.
#pragma once

#include "effort_blends.h"

#include <string>
#include <vector>

#include <strut/effort/effort_regression.h>

namespace strut::study {

/// What one rater said of everything.
struct LabelledSet {
  const FragmentSet* set = nullptr;
  const std::vector<StudyBlend>* shown = nullptr;
  std::vector<effort::LabelledFragment> fragments;
  std::vector<effort::LabelledBlend> blends;    ///< as `shown`
  std::vector<effort::DescriptorScale> scales;  ///< of each group
};
LabelledSet labelled(const FragmentSet& set, const std::vector<StudyBlend>& shown, const Rater& rater);

/// How the blends are shared out: indices of blends.
struct Fold {
  std::vector<int> train, test;
  int group = -1;  ///< that is held out; -1 where none is
};
enum class Split {
  kRandom,      ///< blends at random: their fragments are in other labelled blends
  kFragments,   ///< neither fragment of a test blend is in a labelled one
  kContents,    ///< nor any fragment of its content
  kPerformers,  ///< nor any of one of its performers
  kOutside,     ///< as kFragments, tested on alpha outside [0, 1], of which some are labelled; the others test inside
};
inline constexpr int kNumSplits = 5;
std::vector<Fold> folds_of(Split split, const FragmentSet& set, const std::vector<StudyBlend>& shown,
                           const std::vector<int>& fragment_folds);

/// Errors of one method over all folds.
struct PredictionFigures {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  int count = 0;
  int covered = 0, intervals = 0;  ///< labels inside the predicted 90 % intervals, of those that have one

  void add(const effort::EffortVector& predicted, const effort::EffortVector& deviation,
           const effort::EffortVector& label);
  void add(const PredictionFigures& other);
  [[nodiscard]] double rmse() const;  ///< mean of the three factors'
  [[nodiscard]] double coverage() const { return intervals > 0 ? static_cast<double>(covered) / intervals : 0.0; }
};

/// A way to predict. With `scores_kinematics` blends are made and scored by a KinematicEstimator fitted to the labels.
struct Prediction {
  std::string name;
  effort::RegressionOptions options;
  bool scores_kinematics = false;
};
std::vector<Prediction> predictions();

/// Per fold.
std::vector<PredictionFigures> judge(const LabelledSet& labels, const std::vector<Fold>& folds,
                                     const Prediction& prediction);
PredictionFigures sum(const std::vector<PredictionFigures>& of_folds);

}  // namespace strut::study
