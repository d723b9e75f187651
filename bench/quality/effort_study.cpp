// SPDX-License-Identifier: MIT
// How well are labels of Effort predicted, and how near does what is chosen come to what is wanted? Makes
// docs/effort.md from the text in effort_page.md; every expert in it is synthetic:
//   effort_study CLIPS TEXT PAGE      as `./dev effort` calls it
#include "correspondence_page.h"
#include "effort_choosing.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <utility>

namespace {

using namespace strut;
using namespace strut::study;

constexpr double kNoise = 0.1;  // of raters, unless a row says otherwise
constexpr int kFolds = 5;
constexpr int kWantedPerContent = 12;
constexpr std::size_t kDefault = 4;       // of predictions()
constexpr std::size_t kRepeatEvery = 10;  // of all labels, one is asked for again

/// A set with everything that was made of it once.
struct Study {
  FragmentSet set;
  std::vector<int> folds;
  std::vector<StudyBlend> blends;
  CueScale scale;

  explicit Study(FragmentSet fragments)
      : set(std::move(fragments)),
        folds(fragment_folds(set, kFolds, 1)),
        blends(make_blends(set, plans_to_label(set, folds, 2))) {
    std::vector<int> groups;
    for (const StudyFragment& fragment : set.fragments) groups.push_back(fragment.group);
    scale = cue_scale(set.cues, groups, static_cast<int>(set.contents.size()));
  }
  [[nodiscard]] Rater rater(RaterKind kind, double noise = kNoise) const { return {kind, noise, scale}; }
  [[nodiscard]] LabelledSet labels(RaterKind kind, double noise = kNoise) const {
    return labelled(set, blends, rater(kind, noise));
  }
  [[nodiscard]] std::vector<Fold> shared_out(Split split) const { return folds_of(split, set, blends, folds); }
};

std::string set_table(const Study& study) {
  Table table({"content", "fragments", "shortest, s", "longest, s", "labelled blends"});
  for (int group = 0; group < static_cast<int>(study.set.contents.size()); ++group) {
    double shortest = 1e9, longest = 0.0;
    int blends = 0;
    for (const int i : study.set.group(group)) {
      const double duration = study.set.fragments[static_cast<std::size_t>(i)].motion.duration();
      shortest = std::min(shortest, duration);
      longest = std::max(longest, duration);
    }
    for (const StudyBlend& blend : study.blends) blends += blend.showing(study.set).group == group ? 1 : 0;
    table.add({study.set.contents[static_cast<std::size_t>(group)], std::to_string(study.set.group(group).size()),
               number(shortest, 1), number(longest, 1), std::to_string(blends)});
  }
  return table.markdown();
}

/// All predictions of the plain rater by all splits; in brackets what the 90 % intervals cover.
std::string prediction_table(const Study& study) {
  Table table({"prediction", "random split (leaky)", "fragments held out", "content held out", "performer held out",
               "alpha outside [0, 1]"});
  const LabelledSet labels = study.labels(RaterKind::kPlain);
  for (const Prediction& prediction : predictions()) {
    std::vector<std::string> row{prediction.name};
    for (int split = 0; split < kNumSplits; ++split) {
      const PredictionFigures all = sum(judge(labels, study.shared_out(static_cast<Split>(split)), prediction));
      row.push_back(number(all.rmse(), 3) + (all.intervals > 0 ? " (" + percent(all.coverage()) + ")" : ""));
    }
    table.add(row);
  }
  return table.markdown();
}

std::string content_table(const Study& study) {
  std::vector<std::string> head{"prediction"};
  for (const std::string& content : study.set.contents) head.push_back(content);
  Table table(head);
  const auto all = predictions();
  for (const std::size_t which : {std::size_t{0}, kDefault}) {
    std::vector<std::string> row{all[which].name};
    const LabelledSet labels = study.labels(RaterKind::kPlain);
    for (const PredictionFigures& figures : judge(labels, study.shared_out(Split::kContents), all[which])) {
      row.push_back(number(figures.rmse(), 3));
    }
    table.add(row);
  }
  return table.markdown();
}

/// How far a rater is from itself: one label in ten asked for twice; the deviation of one label.
double repeatability(const Study& study, const Rater& rater) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < study.blends.size(); i += kRepeatEvery, ++count) {
    const Showing showing = study.blends[i].showing(study.set);
    squares += (rater.label(showing, 0) - rater.label(showing, 1)).cwiseAbs2();
  }
  return (0.5 * squares / count).cwiseSqrt().mean();
}

std::string rater_table(const Study& study, const std::vector<double>& noises) {
  Table table({"rater", "noise", "its own repeats", "linear labels", "**the default**", "gain", "90 % intervals cover",
               "content held out: linear", "content held out: **default**"});
  const auto all = predictions();
  for (int kind = 0; kind < kNumRaterKinds; ++kind) {
    for (const double noise : noises) {
      const LabelledSet labels = study.labels(static_cast<RaterKind>(kind), noise);
      const auto by = [&](Split split, std::size_t which) {
        return sum(judge(labels, study.shared_out(split), all[which]));
      };
      const PredictionFigures linear = by(Split::kFragments, 0), ours = by(Split::kFragments, kDefault);
      std::vector<std::string> row{kRaterNames[kind],
                                   number(noise, 1),
                                   number(repeatability(study, study.rater(static_cast<RaterKind>(kind), noise)), 3),
                                   number(linear.rmse(), 3),
                                   number(ours.rmse(), 3),
                                   percent(1.0 - ours.rmse() / linear.rmse()),
                                   percent(ours.coverage())};
      const bool has_contents = noise == kNoise;  // the others would take minutes more
      row.push_back(has_contents ? number(by(Split::kContents, 0).rmse(), 3) : "");
      row.push_back(has_contents ? number(by(Split::kContents, kDefault).rmse(), 3) : "");
      table.add(row);
    }
  }
  return table.markdown();
}

std::string choice_table(const Study& study) {
  const std::vector<StudyBlend> candidates = all_candidates(study.set);
  std::vector<std::vector<ChoiceFigure>> columns;
  std::vector<std::string> head{"choice"};
  for (const RaterKind kind : {RaterKind::kPlain, RaterKind::kInteracting, RaterKind::kCounting}) {
    columns.push_back(judge_choices(study.labels(kind), study.rater(kind), candidates, kWantedPerContent));
    head.emplace_back(kRaterNames[static_cast<int>(kind)]);
  }
  Table table(head);
  for (std::size_t way = 0; way < columns[0].size(); ++way) {
    std::vector<std::string> row{columns[0][way].name};
    for (const auto& column : columns) row.push_back(number(column[way].error, 3));
    table.add(row);
  }
  return table.markdown();
}

std::string labelling_table(const Study& study) {
  std::vector<std::string> head{"rater", "labelled blends are"};
  for (const int count : kLabelCounts) head.push_back(std::to_string(count));
  Table table(head);
  for (const RaterKind kind : {RaterKind::kPlain, RaterKind::kInteracting, RaterKind::kCounting}) {
    const LearningFigures figures = judge_labelling(study.labels(kind), study.shared_out(Split::kFragments));
    const auto row = [&](const char* how, const auto& errors) {
      std::vector<std::string> cells{kRaterNames[static_cast<int>(kind)], how};
      for (const double error : errors) cells.push_back(number(error, 3));
      table.add(cells);
    };
    row("drawn at random", figures.at_random);
    row("**asked for**", figures.asked_for);
  }
  return table.markdown();
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fputs("usage: effort_study CLIPS TEXT PAGE\n", stderr);
    return 2;
  }
  std::map<std::string, std::string> parts;
  const auto add = [&](const char* name, std::string table) {
    std::printf("%s\n\n%s\n", name, table.c_str());
    std::fflush(stdout);  // minutes lie between
    parts[name] = std::move(table);
  };
  const Study gestures(gesture_set(1));
  add("gestures", set_table(gestures));
  add("prediction", prediction_table(gestures));
  add("choices", choice_table(gestures));
  add("labelling", labelling_table(gestures));
  add("contents", content_table(gestures));
  const Study clips(real_set(argv[1]));
  add("real_clips", set_table(clips));
  add("real_prediction", prediction_table(clips));
  add("real_contents", content_table(clips));
  add("raters", rater_table(gestures, {0.0, 0.1, 0.2}));
  add("real_raters", rater_table(clips, {0.1}));
  write_page(argv[2], argv[3], parts);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "effort_study: error: %s\n", error.what());
  return 1;
}
