// SPDX-License-Identifier: MIT
// How well raters repeat, by hand on a few labels.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/effort/rater_consistency.h>

namespace strut {
namespace {

using namespace effort;

LabelRecord label(RecordId fragment, const std::string& rater, double flow, double time, bool is_repeat) {
  LabelRecord made;
  made.target.id = fragment;
  made.rater = rater;
  made.rating << flow, kNotRated, time, kNotRated;
  made.is_repeat = is_repeat;
  return made;
}

TEST(RaterConsistency, ComparesRepeatsWithFirstLabels) {
  const std::vector<LabelRecord> labels{label(1, "ada", 0.5, 0.1, false), label(2, "ada", -0.2, 0.0, false),
                                        label(1, "ada", 0.1, 0.1, true),  label(2, "ada", 0.0, kNotRated, true),
                                        label(3, "eve", 1.0, 1.0, false), label(3, "eve", -1.0, -1.0, true)};
  const RaterConsistency ada = rater_consistency(labels, "ada");
  EXPECT_EQ(ada.num_labels, 4);
  EXPECT_EQ(ada.num_repeats, 2);
  EXPECT_DOUBLE_EQ(ada.mean_difference[kFlow], 0.3);
  EXPECT_DOUBLE_EQ(ada.rms_difference[kFlow], std::sqrt((0.16 + 0.04) / 2.0));
  EXPECT_EQ(ada.num_compared[kTime], 1);
  EXPECT_DOUBLE_EQ(ada.mean_difference[kTime], 0.0);
  EXPECT_FALSE(is_rated(ada.mean_difference[kWeight]));
}

TEST(RaterConsistency, LeavesOutRepeatsWithoutAFirst) {
  const RaterConsistency ada = rater_consistency({label(1, "ada", 0.5, 0.1, true)}, "ada");
  EXPECT_EQ(ada.num_labels, 1);
  EXPECT_EQ(ada.num_repeats, 0);
  EXPECT_FALSE(is_rated(ada.mean_difference[kFlow]));
}

}  // namespace
}  // namespace strut
