// SPDX-License-Identifier: MIT
// From a database to what is learnt from: labelled fragments in groups, pairs of them, labelled blends.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <strut/core/error.h>
#include <strut/effort/content_groups.h>
#include <strut/effort/descriptors.h>
#include <strut/effort/fragment_names.h>
#include <strut/effort/learn_effort.h>
#include <strut/motion/legs.h>

namespace strut::effort {
namespace {

constexpr int kFewestFrames = 4;
constexpr int kFewLabels = 20;  // below, what is learnt is little more than that blends lie between their ends
constexpr const char* kGiveLabels =
    "label fragments and blends: strut effort labels --import LABELS.csv; or start from estimates: strut effort "
    "estimate, then strut effort learn --estimates";

EffortVector effort_of(const Rating& rating) {
  return rating.head<kNumPredictedFactors>();
}

bool says_something(const EffortVector& effort) {
  return is_rated(effort[kFlow]) || is_rated(effort[kWeight]) || is_rated(effort[kTime]);
}

/// What is known of every fragment and blend.
struct Labels {
  std::map<LabelTarget, EffortVector> effort;
  std::set<std::string> raters;
  int count = 0;
  bool are_synthetic = false;
};

Labels estimates_of(const FragmentDatabase& database) {
  Labels labels;
  for (const EstimateRecord& estimate : database.estimates()) {
    if (!says_something(estimate.effort)) continue;
    labels.effort[{TargetKind::kFragment, estimate.fragment}] = estimate.effort;
    ++labels.count;
  }
  if (labels.count == 0) {
    throw InvalidArgument("database", "estimates to learn from", "none", "make them: strut effort estimate");
  }
  return labels;
}

[[noreturn]] void refuse_raters(const FragmentDatabase& database, const std::string& rater) {
  std::set<std::string> all;
  for (const LabelRecord& label : database.labels()) all.insert(label.rater);
  if (all.empty()) throw InvalidArgument("database", "labels to learn from", "none", kGiveLabels);
  std::string names;
  for (const std::string& name : all) names += (names.empty() ? "" : ", ") + name;
  if (!rater.empty()) throw InvalidArgument("rater", "one of those who labelled: " + names, "'" + rater + "'");
  throw InvalidArgument("database", "people's labels to learn from", "synthetic raters' alone: " + names,
                        "--rater NAME learns from one of those");
}

/// The mean of what one rater said, or of what all people did.
Labels labels_of(const FragmentDatabase& database, const std::string& rater) {
  Labels labels;
  for (const LabelRecord& label : database.labels()) {
    const bool is_synthetic = label.source == LabelSource::kSynthetic;
    if (rater.empty() ? is_synthetic : label.rater != rater) continue;
    labels.raters.insert(label.rater);
    labels.are_synthetic |= is_synthetic;
    ++labels.count;
  }
  if (labels.count == 0) refuse_raters(database, rater);
  for (const MeanLabel& mean : database.mean_labels(rater)) labels.effort[mean.target] = effort_of(mean.mean);
  std::erase_if(labels.effort, [](const auto& entry) { return !says_something(entry.second); });
  return labels;
}

/// A fragment that is in a group and long enough, read.
struct ReadFragment {
  FragmentRecord record;
  Motion motion;
};

std::vector<ReadFragment> grouped_fragments(const FragmentDatabase& database) {
  std::vector<ReadFragment> found;
  const std::vector<FragmentRecord> all = database.fragments();
  const double shortest = kFewestFrames * std::max(1.0, database.frame_rate() / kFeatureRate);
  for (const FragmentRecord& record : all) {
    if (record.group < 0 || record.frames.num_frames() < shortest) continue;
    found.push_back({record, database.motion(record)});
  }
  if (found.empty()) {
    throw InvalidArgument(
        "database", "fragments in groups of like content", all.empty() ? "no fragment" : "none",
        all.empty() ? "cut clips into fragments: strut effort segment" : "group them: strut effort match");
  }
  return found;
}

/// The least alike pair that matching accepted; of pairs that people alone accepted, the least alike of those.
double least_alike(const std::vector<PairRecord>& accepted) {
  double by_threshold = 0.0, by_person = 0.0;
  for (const PairRecord& pair : accepted) {
    if (!is_rated(pair.cost)) continue;
    double& most = pair.status == PairStatus::kAccepted ? by_threshold : by_person;
    most = std::max(most, pair.cost);
  }
  constexpr double kLeast = 0.01;  // m: copies of one fragment cost nothing
  return std::max(by_threshold > 0.0 ? by_threshold : by_person, kLeast);
}

/// The labelled ones of `read`, their groups numbered anew, and what is usual in each.
void take_labelled(EffortExamples& examples, const std::vector<ReadFragment>& read, const Labels& labels,
                   const std::map<RecordId, std::string>& names) {
  std::map<int, int> group_of;
  for (const ReadFragment& fragment : read) {
    const auto label = labels.effort.find({TargetKind::kFragment, fragment.record.id});
    if (label == labels.effort.end()) continue;
    const int group = group_of.emplace(fragment.record.group, static_cast<int>(group_of.size())).first->second;
    examples.fragments.push_back({names.at(fragment.record.id), group, fragment.motion, label->second});
    examples.ids.push_back(fragment.record.id);
    examples.performers.push_back(fragment.record.performer);
    examples.actions.push_back(fragment.record.action);
  }
  std::vector<Eigen::MatrixXd> descriptors(group_of.size(), Eigen::MatrixXd(0, kNumDescriptors));
  for (const ReadFragment& fragment : read) {
    const auto group = group_of.find(fragment.record.group);
    if (group == group_of.end()) continue;
    Eigen::MatrixXd& rows = descriptors[static_cast<std::size_t>(group->second)];
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows(1) = describe(fragment.motion).transpose();
  }
  for (const Eigen::MatrixXd& rows : descriptors) examples.scales.push_back(descriptor_scale(rows));
}

void take_pairs_and_blends(EffortExamples& examples, const FragmentDatabase& database,
                           const std::vector<PairRecord>& accepted, const Labels& labels) {
  std::map<RecordId, int> index;
  for (std::size_t i = 0; i < examples.ids.size(); ++i) index[examples.ids[i]] = static_cast<int>(i);
  const auto ends = [&](RecordId one, RecordId other) -> std::optional<FragmentPair> {
    const auto first = index.find(one), second = index.find(other);
    if (first == index.end() || second == index.end()) return std::nullopt;
    const auto group = [&](int i) { return examples.fragments[static_cast<std::size_t>(i)].group; };
    if (group(first->second) != group(second->second)) return std::nullopt;
    return FragmentPair{first->second, second->second};
  };
  for (const PairRecord& pair : accepted) {
    const auto found = ends(pair.first, pair.second);
    if (found) examples.pairs.push_back({std::min(found->first, found->second), std::max(found->first, found->second)});
  }
  for (const BlendRecord& blend : database.blends()) {
    const auto label = labels.effort.find({TargetKind::kBlend, blend.id});
    const auto found = ends(blend.first, blend.second);
    if (label == labels.effort.end() || !found || blend.alpha < kLeastAlpha || blend.alpha > kLargestAlpha) continue;
    examples.blends.push_back({found->first, found->second, blend.alpha, label->second});
  }
}

void warn_of_little(const EffortExamples& examples, bool are_estimates, Diagnostics* diagnostics) {
  if (diagnostics == nullptr) return;
  const auto single = [&](int group) {
    return std::count_if(examples.fragments.begin(), examples.fragments.end(),
                         [&](const ModelFragment& f) { return f.group == group; }) < 2;
  };
  int alone = 0;
  for (int group = 0; group < static_cast<int>(examples.scales.size()); ++group) alone += single(group) ? 1 : 0;
  if (alone > 0) {
    diagnostics->warn("", std::to_string(alone) + " of " + std::to_string(examples.scales.size()) +
                              " groups have one labelled fragment: nothing there can be blended");
  }
  if (!are_estimates && static_cast<int>(examples.fragments.size() + examples.blends.size()) < kFewLabels) {
    diagnostics->warn("",
                      "only " + std::to_string(examples.fragments.size()) + " fragments and " +
                          std::to_string(examples.blends.size()) + " blends are labelled",
                      "label more: strut effort next names the blends that help most");
  }
}

}  // namespace

EffortExamples effort_examples(const FragmentDatabase& database, const LearnOptions& options,
                               Diagnostics* diagnostics) {
  const Labels labels = options.from_estimates ? estimates_of(database) : labels_of(database, options.rater);
  const std::vector<ReadFragment> read = grouped_fragments(database);
  EffortExamples examples;
  take_labelled(examples, read, labels, fragment_names(database));
  if (examples.fragments.empty()) {
    throw InvalidArgument("database", "labelled fragments in groups of like content", "none", kGiveLabels);
  }
  const std::vector<PairRecord> accepted = database.accepted_pairs();
  take_pairs_and_blends(examples, database, accepted, labels);
  if (examples.pairs.empty()) {
    throw InvalidArgument("database", "pairs of labelled fragments that can be blended", "none",
                          accepted.empty() ? "match fragments: strut effort match"
                                           : "label more fragments of one group, or accept pairs by hand");
  }
  std::vector<Motion> motions;
  for (const ReadFragment& fragment : read) motions.push_back(fragment.motion);
  examples.upright = motion::upright_reference(motions);
  std::vector<FrameMatrix> features;
  for (const Motion& motion : motions) features.push_back(joint_features(motion, examples.upright));
  examples.space = fit_feature_space(features);
  for (FrameMatrix& rows : features) rows = project(examples.space, rows);
  // Pairs of one named content are compared by their movement alone, which costs less than a snippet's posture.
  examples.threshold = std::max(least_alike(accepted), like_threshold(features));
  examples.num_labels = labels.count;
  examples.are_synthetic = labels.are_synthetic;
  examples.raters.assign(labels.raters.begin(), labels.raters.end());
  warn_of_little(examples, options.from_estimates, diagnostics);
  return examples;
}

}  // namespace strut::effort
