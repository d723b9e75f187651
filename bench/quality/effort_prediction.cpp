// SPDX-License-Identifier: MIT
#include "effort_prediction.h"

#include <cmath>
#include <random>

#include <tbb/parallel_for.h>

#include <strut/effort/effort_estimate.h>

namespace strut::study {
namespace {

using effort::EffortVector;

constexpr double kNinetyPercent = 1.6449;  // deviations of a normal distribution
constexpr int kNumRandomFolds = 5;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Folds by a predicate of (blend, fold): whether it tests, whether it may be learnt from.
template <typename Tests, typename Trains>
std::vector<Fold> folds_by(int num_folds, const std::vector<StudyBlend>& shown, Tests tests, Trains trains) {
  std::vector<Fold> folds(at(num_folds));
  for (int fold = 0; fold < num_folds; ++fold) {
    for (int i = 0; i < static_cast<int>(shown.size()); ++i) {
      if (tests(i, fold))
        folds[at(fold)].test.push_back(i);
      else if (trains(i, fold))
        folds[at(fold)].train.push_back(i);
    }
  }
  return folds;
}

/// What is left of a set of labels where only `train` may be learnt from.
std::vector<effort::LabelledBlend> chosen(const LabelledSet& labels, const std::vector<int>& train) {
  std::vector<effort::LabelledBlend> blends;
  for (const int i : train) blends.push_back(labels.blends[at(i)]);
  return blends;
}

PredictionFigures by_regression(const LabelledSet& labels, const Fold& fold, const effort::RegressionOptions& options) {
  const auto regression = effort::fit_effort_regression(labels.fragments, chosen(labels, fold.train), options);
  PredictionFigures figures;
  for (const int i : fold.test) {
    const effort::LabelledBlend& blend = labels.blends[at(i)];
    const auto predicted = regression.predict(blend.first, blend.second, Eigen::VectorXd::Constant(1, blend.alpha));
    figures.add(predicted[0].effort, predicted[0].deviation, blend.effort);
  }
  return figures;
}

effort::LabelledDescriptors described(int group, const Eigen::VectorXd& cues, const EffortVector& effort) {
  return {group, cues.head(effort::kNumDescriptors), effort};
}

PredictionFigures by_kinematics(const LabelledSet& labels, const Fold& fold) {
  std::vector<effort::LabelledDescriptors> seen;
  const auto group = [&](const effort::LabelledBlend& blend) { return labels.fragments[at(blend.first)].group; };
  for (const int i : fold.train) {
    seen.push_back(described(group(labels.blends[at(i)]), (*labels.shown)[at(i)].cues, labels.blends[at(i)].effort));
  }
  const auto estimator = effort::KinematicEstimator::fit(labels.scales, seen);
  PredictionFigures figures;
  for (const int i : fold.test) {
    const Eigen::VectorXd& cues = (*labels.shown)[at(i)].cues;
    const auto estimate = estimator.estimate(group(labels.blends[at(i)]), cues.head(effort::kNumDescriptors));
    figures.add(estimate.effort, estimator.numbers().left_out_error, labels.blends[at(i)].effort);
  }
  return figures;
}

}  // namespace

LabelledSet labelled(const FragmentSet& set, const std::vector<StudyBlend>& shown, const Rater& rater) {
  LabelledSet labels{&set, &shown, {}, {}, {}};
  std::vector<int> groups;
  for (int i = 0; i < static_cast<int>(set.fragments.size()); ++i) {
    groups.push_back(set.fragments[at(i)].group);
    const EffortVector said = rater.label({groups.back(), set.cues[at(i)], fragment_id(i)});
    labels.fragments.push_back({set.features[at(i)], said, groups.back()});
  }
  for (const StudyBlend& blend : shown) {
    labels.blends.push_back({blend.first, blend.second, blend.alpha, rater.label(blend.showing(set))});
  }
  labels.scales = cue_scale(set.cues, groups, static_cast<int>(set.contents.size())).descriptors;
  return labels;
}

std::vector<Fold> folds_of(Split split, const FragmentSet& set, const std::vector<StudyBlend>& shown,
                           const std::vector<int>& fragment_folds) {
  const auto inside = [&](int i) { return !shown[at(i)].is_outside(); };
  const auto both = [&](int i, int fold) {
    return fragment_folds[at(shown[at(i)].first)] == fold && fragment_folds[at(shown[at(i)].second)] == fold;
  };
  const auto neither = [&](int i, int fold) {
    return fragment_folds[at(shown[at(i)].first)] != fold && fragment_folds[at(shown[at(i)].second)] != fold;
  };
  const auto group = [&](int i) { return set.fragments[at(shown[at(i)].first)].group; };
  const auto has_performer = [&](int i, int performer) {
    return set.fragments[at(shown[at(i)].first)].performer == performer ||
           set.fragments[at(shown[at(i)].second)].performer == performer;
  };
  const int num_folds = 1 + *std::max_element(fragment_folds.begin(), fragment_folds.end());
  const int num_groups = static_cast<int>(set.contents.size());
  switch (split) {
    case Split::kRandom: {
      std::mt19937_64 random(5);
      std::vector<int> share(shown.size());
      for (int& fold : share) fold = static_cast<int>(random() % kNumRandomFolds);
      return folds_by(
          kNumRandomFolds, shown, [&](int i, int fold) { return inside(i) && share[at(i)] == fold; },
          [&](int i, int) { return inside(i); });
    }
    case Split::kFragments:
      return folds_by(
          num_folds, shown, [&](int i, int fold) { return inside(i) && both(i, fold); },
          [&](int i, int fold) { return inside(i) && neither(i, fold); });
    case Split::kContents: {
      auto folds = folds_by(
          num_groups, shown, [&](int i, int fold) { return inside(i) && group(i) == fold; },
          [&](int i, int) { return inside(i); });
      for (int g = 0; g < num_groups; ++g) folds[at(g)].group = g;
      return folds;
    }
    case Split::kPerformers:
      return folds_by(
          set.num_performers, shown, [&](int i, int fold) { return inside(i) && has_performer(i, fold); },
          [&](int i, int) { return inside(i); });
    case Split::kOutside:
      return folds_by(
          num_folds, shown, [&](int i, int fold) { return !inside(i) && both(i, fold); }, neither);
  }
  return {};
}

void PredictionFigures::add(const EffortVector& predicted, const EffortVector& deviation, const EffortVector& label) {
  squares += (predicted - label).cwiseAbs2();
  ++count;
  for (int factor = 0; factor < effort::kNumPredictedFactors; ++factor) {
    if (!effort::is_rated(deviation[factor])) continue;
    ++intervals;
    if (std::abs(predicted[factor] - label[factor]) <= kNinetyPercent * deviation[factor]) ++covered;
  }
}

void PredictionFigures::add(const PredictionFigures& other) {
  squares += other.squares;
  count += other.count;
  covered += other.covered;
  intervals += other.intervals;
}

double PredictionFigures::rmse() const {
  return count > 0 ? (squares / count).cwiseSqrt().mean() : 0.0;
}

std::vector<Prediction> predictions() {
  using Method = effort::RegressionMethod;
  return {{"linear labels (1 - a) e_i + a e_j", {.method = Method::kLinearLabels}},
          {"nearest end", {.method = Method::kNearestEnd}},
          {"support vectors, as in the paper", {.method = Method::kSupportVector}},
          {"linear + residual, posture and labels alone", {.uses_kinematics = false}},
          {"**linear + residual** (the default)", {}},
          {"the blend made, and its kinematics scored", {}, true}};
}

std::vector<PredictionFigures> judge(const LabelledSet& labels, const std::vector<Fold>& folds,
                                     const Prediction& prediction) {
  std::vector<PredictionFigures> figures(folds.size());
  tbb::parallel_for(std::size_t{0}, folds.size(), [&](std::size_t i) {
    figures[i] = prediction.scores_kinematics ? by_kinematics(labels, folds[i])
                                              : by_regression(labels, folds[i], prediction.options);
  });
  return figures;
}

PredictionFigures sum(const std::vector<PredictionFigures>& of_folds) {
  PredictionFigures all;
  for (const PredictionFigures& figures : of_folds) all.add(figures);
  return all;
}

}  // namespace strut::study
