// SPDX-License-Identifier: MIT
#include "small_effort.h"

#include <random>

#include <strut/motion/legs.h>

namespace strut::test {
namespace {

using effort::EffortVector;

constexpr int kPerGroup = 8;
constexpr double kThreshold = 0.35;  // m: between gestures of one kind at most 0.3, of both kinds at least 0.5

generate::GestureContent content_of(int group) {
  return generate::gesture_content(group == kReaches ? generate::GestureAction::kReach
                                                     : generate::GestureAction::kLift);
}

Motion made(int group, const EffortVector& effort, std::uint64_t seed, double frame_rate,
            const generate::Performer& who) {
  const generate::GestureStyle style{.suddenness = effort[effort::kTime],
                                     .boundness = effort[effort::kFlow],
                                     .strength = effort[effort::kWeight],
                                     .seed = seed};
  return generate::generate_gesture(content_of(group), style, who, frame_rate).motion;
}

void add_gestures(effort::EffortExamples& examples, int group) {
  std::mt19937_64 random(static_cast<std::uint64_t>(group) + 5);
  std::uniform_real_distribution<double> any(-0.9, 0.9);
  Eigen::MatrixXd descriptors(kPerGroup, effort::kNumDescriptors);
  const int first = static_cast<int>(examples.fragments.size());
  for (int i = 0; i < kPerGroup; ++i) {
    const EffortVector effort(any(random), any(random), -0.9 + 1.8 * i / (kPerGroup - 1));
    Motion motion = made(group, effort, random(), 30.0, {});
    descriptors.row(i) = effort::describe(motion).transpose();
    for (int j = first; j < first + i; ++j) examples.pairs.push_back({j, first + i});
    examples.fragments.push_back({"gesture " + std::to_string(first + i), group, std::move(motion), effort});
  }
  // As a rater who hears of nothing but the ends would.
  for (int i = 0; i + 1 < kPerGroup; ++i) {
    const auto of = [&](int k) { return examples.fragments[static_cast<std::size_t>(first + k)].effort; };
    examples.blends.push_back({first + i, first + i + 1, 0.5, 0.5 * of(i) + 0.5 * of(i + 1)});
  }
  examples.scales.push_back(effort::descriptor_scale(descriptors));
}

effort::EffortExamples make_examples() {
  effort::EffortExamples examples;
  for (const int group : {kReaches, kLifts}) add_gestures(examples, group);
  std::vector<Motion> motions;
  for (const effort::ModelFragment& fragment : examples.fragments) motions.push_back(fragment.motion);
  examples.upright = motion::upright_reference(motions);
  std::vector<FrameMatrix> features;
  for (const Motion& motion : motions) features.push_back(effort::joint_features(motion, examples.upright));
  examples.space = effort::fit_feature_space(features);
  examples.threshold = kThreshold;
  return examples;
}

}  // namespace

Motion gesture(int group, const EffortVector& effort, double frame_rate, const generate::Performer& who) {
  constexpr std::uint64_t kUnseen = 1000;
  return made(group, effort, kUnseen, frame_rate, who);
}

const effort::EffortExamples& small_examples() {
  static const effort::EffortExamples examples = make_examples();
  return examples;
}

const std::shared_ptr<const effort::EffortModel>& small_effort_model() {
  static const auto model = effort::learn_effort(small_examples(), {});
  return model;
}

}  // namespace strut::test
