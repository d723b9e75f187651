// SPDX-License-Identifier: MIT
#include "effort_choosing.h"

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include <tbb/parallel_for.h>

#include <strut/effort/blend_choice.h>
#include <strut/effort/next_labels.h>

namespace strut::study {
namespace {

using effort::EffortVector;

constexpr double kWantedRange = 0.8;
constexpr double kAlphaStep = 0.125;
constexpr int kDraws = 4;         // of random labels
constexpr int kAskedAtOnce = 10;  // before it is learnt again

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// What `strut effort learn` would make of the labels.
std::shared_ptr<const effort::EffortModel> model_of(const LabelledSet& labels,
                                                    const std::vector<StudyBlend>& candidates) {
  std::vector<effort::ModelFragment> fragments;
  std::vector<effort::LabelledDescriptors> described;
  for (std::size_t i = 0; i < labels.fragments.size(); ++i) {
    const StudyFragment& fragment = labels.set->fragments[i];
    const EffortVector& said = labels.fragments[i].effort;
    fragments.push_back({"fragment " + std::to_string(i), fragment.group, fragment.motion, said});
    described.push_back({fragment.group, labels.set->cues[i].head(effort::kNumDescriptors), said});
  }
  for (std::size_t i = 0; i < labels.blends.size(); ++i) {
    const int group = labels.fragments[at(labels.blends[i].first)].group;
    described.push_back({group, (*labels.shown)[i].cues.head(effort::kNumDescriptors), labels.blends[i].effort});
  }
  std::set<std::pair<int, int>> blendable;
  for (const StudyBlend& blend : candidates) blendable.insert({blend.first, blend.second});
  std::vector<effort::FragmentPair> pairs;
  for (const auto& [first, second] : blendable) pairs.push_back({first, second});
  return std::make_shared<const effort::EffortModel>(effort::EffortModelParts{
      labels.set->upright, effort::fit_feature_space(labels.set->features), std::move(fragments), std::move(pairs),
      effort::fit_effort_regression(labels.fragments, labels.blends),
      effort::KinematicEstimator::fit(labels.scales, described), 0.1});
}

EffortVector realized(const effort::BlendChooser& chooser, const effort::ChosenBlend& chosen, int group,
                      const Rater& rater) {
  const Eigen::VectorXd cues = movement_cues(chooser.synthesize(chosen).motion);
  return rater.judged({group, cues, blend_id(chosen.first, chosen.second, chosen.alpha)});
}

struct Wanted {
  int group;
  EffortVector effort;
};

std::vector<Wanted> draw_wanted(int num_groups, int per_content) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> value(-kWantedRange, kWantedRange);
  std::vector<Wanted> all;
  for (int group = 0; group < num_groups; ++group) {
    for (int i = 0; i < per_content; ++i) {
      Wanted wanted{group, {}};
      for (double& factor : wanted.effort) factor = value(random);
      all.push_back(wanted);
    }
  }
  return all;
}

/// The least distance over all fragments and candidates: what cannot be beaten.
double oracle_error(const LabelledSet& labels, const Rater& rater, const std::vector<StudyBlend>& candidates,
                    const std::vector<Wanted>& wanted) {
  std::vector<std::pair<int, EffortVector>> shown;
  for (std::size_t i = 0; i < labels.fragments.size(); ++i) {
    const int group = labels.fragments[i].group;
    shown.emplace_back(group, rater.judged({group, labels.set->cues[i], fragment_id(static_cast<int>(i))}));
  }
  for (const StudyBlend& blend : candidates) {
    const Showing showing = blend.showing(*labels.set);
    shown.emplace_back(showing.group, rater.judged(showing));
  }
  double sum = 0.0;
  for (const Wanted& want : wanted) {
    double least = 1e9;
    for (const auto& [group, effort] : shown) {
      if (group == want.group) least = std::min(least, (effort - want.effort).norm());
    }
    sum += least;
  }
  return sum / static_cast<double>(wanted.size());
}

/// RMSE on the test blends after learning from `train`.
PredictionFigures learnt(const LabelledSet& labels, const std::vector<effort::LabelledBlend>& train,
                         const std::vector<int>& test) {
  const auto regression = effort::fit_effort_regression(labels.fragments, train);
  PredictionFigures figures;
  for (const int i : test) {
    const effort::LabelledBlend& blend = labels.blends[at(i)];
    const auto predicted = regression.predict(blend.first, blend.second, Eigen::VectorXd::Constant(1, blend.alpha));
    figures.add(predicted[0].effort, predicted[0].deviation, blend.effort);
  }
  return figures;
}

using CountFigures = std::array<PredictionFigures, kLabelCounts.size()>;

CountFigures label_at_random(const LabelledSet& labels, const Fold& fold, std::uint64_t seed) {
  std::vector<int> order = fold.train;
  std::mt19937_64 random(seed);
  std::shuffle(order.begin(), order.end(), random);
  CountFigures figures;
  for (std::size_t k = 0; k < kLabelCounts.size(); ++k) {
    std::vector<effort::LabelledBlend> train;
    for (int i = 0; i < kLabelCounts[k]; ++i) train.push_back(labels.blends[at(order[at(i)])]);
    figures[k] = learnt(labels, train, fold.test);
  }
  return figures;
}

CountFigures label_what_is_asked(const LabelledSet& labels, const Fold& fold) {
  std::vector<effort::LabelledBlend> train, candidates;
  for (const int i : fold.train) candidates.push_back(labels.blends[at(i)]);
  CountFigures figures;
  figures[0] = learnt(labels, train, fold.test);
  for (std::size_t k = 1; k < kLabelCounts.size(); ++k) {
    while (static_cast<int>(train.size()) < kLabelCounts[k]) {
      const auto regression = effort::fit_effort_regression(labels.fragments, train);
      for (const auto& asked : effort::next_labels(regression, candidates, {.count = kAskedAtOnce})) {
        const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const auto& blend) {
          return blend.first == asked.first && blend.second == asked.second && blend.alpha == asked.alpha;
        });
        train.push_back(*found);
        candidates.erase(found);
      }
    }
    figures[k] = learnt(labels, train, fold.test);
  }
  return figures;
}

}  // namespace

std::vector<StudyBlend> all_candidates(const FragmentSet& set) {
  std::vector<double> alphas;
  for (double alpha = -0.5; alpha <= 1.5; alpha += kAlphaStep) {
    if (alpha != 0.0 && alpha != 1.0) alphas.push_back(alpha);
  }
  std::vector<BlendPlan> plans;
  for (int group = 0; group < static_cast<int>(set.contents.size()); ++group) {
    const auto of_group = all_pairs(set, group, alphas);
    plans.insert(plans.end(), of_group.begin(), of_group.end());
  }
  return make_blends(set, plans);
}

std::vector<ChoiceFigure> judge_choices(const LabelledSet& labels, const Rater& rater,
                                        const std::vector<StudyBlend>& candidates, int per_content) {
  const effort::BlendChooser chooser(model_of(labels, candidates));
  const std::vector<Wanted> wanted = draw_wanted(chooser.model().num_groups(), per_content);
  const std::vector<std::pair<std::string, effort::ChoiceOptions>> ways = {
      {"best single fragment, by its label", {}},
      {"Eq. (2), alpha in [0, 1]", {.least_alpha = 0.0, .greatest_alpha = 1.0, .num_candidates = 1}},
      {"Eq. (2), alpha in [-0.5, 1.5]", {.num_candidates = 1}},
      {"**best 20 made and scored again** (the default)", {}}};
  std::vector<ChoiceFigure> figures;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    std::vector<double> errors(wanted.size());
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
      const Wanted& want = wanted[i];
      const auto chosen = way == 0 ? chooser.choose_fragment(want.group, want.effort)
                                   : chooser.choose(want.group, want.effort, ways[way].second);
      errors[i] = (realized(chooser, chosen, want.group, rater) - want.effort).norm();
    });
    double sum = 0.0;
    for (const double error : errors) sum += error;
    figures.push_back({ways[way].first, sum / static_cast<double>(errors.size())});
  }
  figures.push_back({"the best there is, by an oracle", oracle_error(labels, rater, candidates, wanted)});
  return figures;
}

LearningFigures judge_labelling(const LabelledSet& labels, const std::vector<Fold>& folds) {
  std::vector<CountFigures> asked(folds.size()), drawn(folds.size() * kDraws);
  tbb::parallel_for(std::size_t{0}, folds.size() * (kDraws + 1), [&](std::size_t i) {
    const std::size_t fold = i % folds.size();
    if (i < folds.size())
      asked[i] = label_what_is_asked(labels, folds[fold]);
    else
      drawn[i - folds.size()] = label_at_random(labels, folds[fold], i);
  });
  LearningFigures figures;
  for (std::size_t k = 0; k < kLabelCounts.size(); ++k) {
    PredictionFigures by_asking, by_chance;
    for (const CountFigures& one : asked) by_asking.add(one[k]);
    for (const CountFigures& one : drawn) by_chance.add(one[k]);
    figures.asked_for[k] = by_asking.rmse();
    figures.at_random[k] = by_chance.rmse();
  }
  return figures;
}

}  // namespace strut::study
