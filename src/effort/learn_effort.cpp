// SPDX-License-Identifier: MIT
// From examples to a model: the regression from labels of fragments and blends, the estimator from how they move.
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/effort/descriptors.h>
#include <strut/effort/learn_effort.h>
#include <strut/effort/space_time_blend.h>

namespace strut::effort {
namespace {

/// The labelled blends as they move; without those that cannot be blended.
std::vector<LabelledDescriptors> described_blends(const EffortExamples& examples) {
  std::vector<std::optional<LabelledDescriptors>> described(examples.blends.size());
  tbb::parallel_for(std::size_t{0}, described.size(), [&](std::size_t i) {
    const LabelledBlend& blend = examples.blends[i];
    const ModelFragment& first = examples.fragments[static_cast<std::size_t>(blend.first)];
    try {
      const SpaceTimeBlend pair(first.motion, examples.fragments[static_cast<std::size_t>(blend.second)].motion);
      described[i] = {first.group, describe(pair.at(blend.alpha).motion), blend.effort};
    } catch (const InvalidArgument&) {
      // too far apart in posture or duration, or too short
    }
  });
  std::vector<LabelledDescriptors> found;
  for (auto& one : described) {
    if (one) found.push_back(*std::move(one));
  }
  return found;
}

KinematicEstimator fit_estimator(const EffortExamples& examples) {
  std::vector<LabelledDescriptors> labels = described_blends(examples);
  for (const ModelFragment& fragment : examples.fragments) {
    labels.push_back({fragment.group, describe(fragment.motion), fragment.effort});
  }
  return KinematicEstimator::fit(examples.scales, labels);
}

}  // namespace

std::vector<LabelledFragment> labelled_fragments(const EffortExamples& examples) {
  std::vector<LabelledFragment> fragments;
  for (const ModelFragment& fragment : examples.fragments) {
    fragments.push_back(
        {matching_features(fragment.motion, examples.upright, examples.space), fragment.effort, fragment.group});
  }
  return fragments;
}

std::shared_ptr<const EffortModel> learn_effort(const EffortExamples& examples, const LearnOptions& options,
                                                const std::string& provenance, Diagnostics* diagnostics) {
  EffortModelParts parts{
      examples.upright,
      examples.space,
      examples.fragments,
      examples.pairs,
      fit_effort_regression(labelled_fragments(examples), examples.blends, options.regression, diagnostics),
      fit_estimator(examples),
      examples.threshold,
      options.from_estimates,
      provenance};
  return std::make_shared<const EffortModel>(std::move(parts));
}

}  // namespace strut::effort
