// SPDX-License-Identifier: MIT
#include "small_effort.h"
#include "support/data.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/learn_effort.h>

namespace strut::effort {
namespace {

using test::gesture;
using test::kLifts;
using test::kReaches;

LabelRecord label_of(const LabelTarget& target, const std::string& rater, double time) {
  LabelRecord label;
  label.target = target;
  label.rater = rater;
  label.labelled_at = "2026-03-01T14:05:00Z";
  label.rating[kTime] = time;
  return label;
}

/// Three reaches of group 4, one lift of group 2, one fragment of no group; the reaches are all accepted pairs.
class EffortExamplesOf : public testing::Test {
 protected:
  EffortExamplesOf()
      : database_(FragmentDatabase::create(folder_.file("moves.db"),
                                           gesture(kReaches, EffortVector::Zero()).shared_skeleton(), 30.0)) {
    for (int i = 0; i < 5; ++i) {
      const Motion motion = gesture(i < 3 ? kReaches : kLifts, EffortVector(0.0, 0.0, 0.3 * i - 0.5));
      database_.add_clip({"clip " + std::to_string(i), "mia", "move"}, motion, {{0, motion.num_frames()}});
    }
    for (const FragmentRecord& fragment : database_.fragments()) ids_.push_back(fragment.id);
    std::vector<PairRecord> pairs;
    for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      pairs.push_back({id(i), id(j), 0.1 * j, 0.0, PairStatus::kAccepted});
    }
    database_.set_matching({{id(0), 4}, {id(1), 4}, {id(2), 4}, {id(3), 2}, {id(4), -1}}, pairs);
  }
  [[nodiscard]] RecordId id(int i) const { return ids_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] LabelTarget fragment(int i) const { return {TargetKind::kFragment, id(i)}; }

  test::TemporaryFolder folder_;
  FragmentDatabase database_;
  std::vector<RecordId> ids_;
};

TEST_F(EffortExamplesOf, TakesASyntheticRaterOnlyIfNamed) {
  std::vector<LabelRecord> labels;
  for (int i = 0; i < 3; ++i) {
    labels.push_back(label_of(fragment(i), "formula", 0.9));
    labels.back().source = LabelSource::kSynthetic;
  }
  database_.add_labels(labels);
  try {
    effort_examples(database_, {});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("synthetic raters' alone: formula"), std::string::npos) << error.what();
    EXPECT_NE(error.hint().find("--rater"), std::string::npos);
  }
  LearnOptions named;
  named.rater = "formula";
  const EffortExamples alone = effort_examples(database_, named);
  EXPECT_TRUE(alone.are_synthetic);
  EXPECT_EQ(alone.num_labels, 3);
  database_.add_labels({label_of(fragment(0), "ana", 0.2), label_of(fragment(1), "ana", 0.3)});
  const EffortExamples people = effort_examples(database_, {});
  EXPECT_FALSE(people.are_synthetic);
  EXPECT_EQ(people.raters, std::vector<std::string>{"ana"});
  ASSERT_EQ(people.fragments.size(), 2U);
  EXPECT_EQ(people.fragments[0].effort[kTime], 0.2);
}

TEST_F(EffortExamplesOf, BringsLabelsOfAllRatersTogether) {
  const RecordId blend = database_.add_blend(id(0), id(2), 0.5);
  database_.add_labels({label_of(fragment(0), "ana", 0.2), label_of(fragment(0), "ben", 0.4),
                        label_of(fragment(2), "ana", -0.6), label_of(fragment(3), "ana", 0.1),
                        label_of(fragment(4), "ana", 0.9), label_of({TargetKind::kBlend, blend}, "ben", 0.0)});
  Diagnostics diagnostics;
  const EffortExamples examples = effort_examples(database_, {}, &diagnostics);
  ASSERT_EQ(examples.fragments.size(), 3U) << "labelled, in a group";
  EXPECT_NEAR(examples.fragments[0].effort[kTime], 0.3, 1e-12);
  EXPECT_FALSE(is_rated(examples.fragments[0].effort[kFlow]));
  EXPECT_EQ(examples.fragments[1].group, 0);
  EXPECT_EQ(examples.fragments[2].group, 1);
  EXPECT_EQ(examples.pairs, (std::vector<FragmentPair>{{0, 1}}));
  ASSERT_EQ(examples.blends.size(), 1U);
  EXPECT_EQ(examples.blends[0].second, 1);
  EXPECT_EQ(examples.scales[0].num_fragments, 3) << "what is usual is seen from unlabelled fragments too";
  EXPECT_GE(examples.threshold, 0.2);  // of the least alike pair that was accepted
  EXPECT_EQ(examples.raters, (std::vector<std::string>{"ana", "ben"}));
  EXPECT_GE(diagnostics.entries().size(), 2U) << "one group with nothing to blend; few labels";
  const auto model = learn_effort(examples, {});
  EXPECT_EQ(model->num_groups(), 2);

  LearnOptions ben;
  ben.rater = "ben";
  EXPECT_THROW(effort_examples(database_, ben), InvalidArgument) << "one fragment alone";
  LearnOptions ana;
  ana.rater = "ana";
  EXPECT_EQ(effort_examples(database_, ana).fragments[0].effort[kTime], 0.2);
}

TEST_F(EffortExamplesOf, NeverMixesLabelsAndEstimates) {
  std::vector<EstimateRecord> estimates;
  for (const int i : {0, 1, 2}) estimates.push_back({id(i), EffortVector(0.1, 0.2, 0.3), EffortVector::Ones()});
  database_.set_estimates(estimates);
  EXPECT_THROW(effort_examples(database_, {}), InvalidArgument) << "estimates are no labels";
  database_.add_labels({label_of(fragment(0), "ana", -0.9), label_of(fragment(1), "ana", -0.8)});
  LearnOptions from_estimates;
  from_estimates.from_estimates = true;
  const EffortExamples estimated = effort_examples(database_, from_estimates);
  ASSERT_EQ(estimated.fragments.size(), 3U);
  EXPECT_EQ(estimated.fragments[0].effort, EffortVector(0.1, 0.2, 0.3));
  EXPECT_TRUE(estimated.raters.empty());
  EXPECT_TRUE(learn_effort(estimated, from_estimates)->parts().are_estimates);
  const EffortExamples labelled = effort_examples(database_, {});
  ASSERT_EQ(labelled.fragments.size(), 2U);
  EXPECT_EQ(labelled.fragments[0].effort[kTime], -0.9);
}

}  // namespace
}  // namespace strut::effort
