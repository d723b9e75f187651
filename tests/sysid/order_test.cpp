// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/order.h>

namespace strut::sysid {
namespace {

TEST(SmallestGoodOrder, IsTheFirstNearTheBest) {
  EXPECT_EQ(smallest_good_order({10.0, 59.4, 59.5, 60.0, 12.0}, 0.5), 2);
  EXPECT_EQ(smallest_good_order({10.0, 59.4, 59.5, 60.0, 12.0}, 0.0), 3);
  EXPECT_EQ(smallest_good_order({-3.0}, 0.5), 0);
  EXPECT_THROW(smallest_good_order({}, 0.5), InvalidArgument);
}

TEST(AssignFolds, KeepsGroupsTogetherAndFoldsEven) {
  const std::vector<int> groups = {5, 5, 9, 2, 2, 9, 4};
  const std::vector<int> weights = {30, 30, 10, 20, 20, 10, 40};  // groups: 5 weighs 60, 2 and 4 weigh 40, 9 weighs 20
  EXPECT_EQ(assign_folds(groups, weights, 2), (std::vector<int>{0, 0, 0, 1, 1, 0, 1}));
}

TEST(AssignFolds, UsesNoMoreFoldsThanThereAreGroups) {
  EXPECT_EQ(assign_folds({1, 1, 2}, {1, 1, 1}, 4), (std::vector<int>{0, 0, 1}));
  EXPECT_TRUE(assign_folds({}, {}, 3).empty());
}

TEST(AssignFolds, RefusesWhatCannotBeMeant) {
  EXPECT_THROW(assign_folds({1}, {1, 2}, 2), InvalidArgument);
  EXPECT_THROW(assign_folds({1}, {1}, 0), InvalidArgument);
}

std::vector<int> random_groups(std::size_t clips) {
  return *rc::gen::container<std::vector<int>>(clips, rc::gen::inRange(0, 5));
}

std::set<int> groups_of(const std::vector<Role>& round, Role role, const std::vector<int>& groups) {
  std::set<int> found;
  for (std::size_t k = 0; k < round.size(); ++k) {
    if (round[k] == role) found.insert(groups[k]);
  }
  return found;
}

bool are_apart(const std::set<int>& some, const std::set<int>& others) {
  return std::none_of(some.begin(), some.end(), [&](int group) { return others.contains(group); });
}

/// Whether no clip is tested that shares an input or an output group with a clip to learn from, and none twice.
bool keeps_apart(const LeaveOut& leave_out, const std::vector<int>& input_groups,
                 const std::vector<int>& output_groups) {
  std::vector<int> tested(input_groups.size(), 0);
  for (const std::vector<Role>& round : leave_out.rounds) {
    if (round.size() != input_groups.size()) return false;
    for (const std::vector<int>& groups : {input_groups, output_groups}) {
      if (!are_apart(groups_of(round, Role::kLearn, groups), groups_of(round, Role::kTest, groups))) return false;
    }
    for (std::size_t k = 0; k < round.size(); ++k) tested[k] += round[k] == Role::kTest ? 1 : 0;
  }
  return std::all_of(tested.begin(), tested.end(), [](int times) { return times <= 1; });
}

TEST(LeaveOut, IsSeenWhenItMixes) {
  EXPECT_TRUE(keeps_apart({{{Role::kTest, Role::kLearn}}}, {1, 2}, {1, 2}));
  EXPECT_FALSE(keeps_apart({{{Role::kTest, Role::kLearn}}}, {1, 1}, {1, 2}));
  EXPECT_FALSE(keeps_apart({{{Role::kTest, Role::kLearn}}}, {1, 2}, {2, 2}));
  EXPECT_FALSE(keeps_apart({{{Role::kTest}, {Role::kTest}}}, {1}, {1})) << "tested twice";
  EXPECT_FALSE(keeps_apart({{{Role::kTest}}}, {1, 2}, {1, 2})) << "a clip without a role";
}

RC_GTEST_PROP(LeaveOut, NeverLearnsFromRelativesOfWhatItTests, ()) {
  const auto clips = *rc::gen::inRange<std::size_t>(0, 13);
  const std::vector<int> inputs = random_groups(clips), outputs = random_groups(clips);
  const auto weights = *rc::gen::container<std::vector<int>>(clips, rc::gen::inRange(0, 100));
  const int folds = *rc::gen::inRange(1, 6);
  RC_ASSERT(keeps_apart(leave_out_pairs(inputs, outputs, weights, folds), inputs, outputs));
  RC_ASSERT(keeps_apart(leave_out_groups(inputs, weights, folds), inputs, inputs));
}

RC_GTEST_PROP(LeaveOut, OfGroupsTestsEveryClipAndUsesAll, ()) {
  const auto clips = *rc::gen::inRange<std::size_t>(1, 13);
  const std::vector<int> groups = random_groups(clips);
  const LeaveOut leave_out = leave_out_groups(groups, std::vector<int>(clips, 1), *rc::gen::inRange(1, 6));
  for (std::size_t k = 0; k < clips; ++k) {
    const auto tests = [k](const std::vector<Role>& round) { return round[k] == Role::kTest; };
    RC_ASSERT(std::count_if(leave_out.rounds.begin(), leave_out.rounds.end(), tests) == 1);
  }
  for (const std::vector<Role>& round : leave_out.rounds) {
    RC_ASSERT(std::count(round.begin(), round.end(), Role::kUnused) == 0);
  }
}

TEST(LeaveOut, OfPairsLeavesOutWhatSharesOneSide) {
  // Inputs 0 and 1 with outputs 0 and 1, each with each; the diagonal weighs more.
  const LeaveOut leave_out = leave_out_pairs({0, 0, 1, 1}, {0, 1, 0, 1}, {9, 1, 1, 9}, 2);
  constexpr Role kLearn = Role::kLearn, kTest = Role::kTest, kUnused = Role::kUnused;
  ASSERT_EQ(leave_out.rounds.size(), 2u);
  EXPECT_EQ(leave_out.rounds[0], (std::vector<Role>{kTest, kUnused, kUnused, kLearn}));
  EXPECT_EQ(leave_out.rounds[1], (std::vector<Role>{kLearn, kUnused, kUnused, kTest}));
}

TEST(LeaveOut, OfPairsTestsFoldsThatMeet) {
  // Input 0 is paired with output 1 and input 1 with output 0 only: folds of like number share no clip.
  const LeaveOut leave_out = leave_out_pairs({0, 1}, {1, 0}, {1, 1}, 2);
  ASSERT_EQ(leave_out.rounds.size(), 2u);
  EXPECT_EQ(leave_out.rounds[0], (std::vector<Role>{Role::kTest, Role::kLearn}));
  EXPECT_EQ(leave_out.rounds[1], (std::vector<Role>{Role::kLearn, Role::kTest}));
}

TEST(LeaveOut, OfOneGroupHasNothingToLearnFrom) {
  for (const LeaveOut& leave_out : {leave_out_groups({7, 7}, {1, 2}, 4), leave_out_groups({1, 2}, {1, 2}, 1),
                                    leave_out_pairs({7, 7}, {7, 7}, {1, 2}, 4)}) {
    ASSERT_EQ(leave_out.rounds.size(), 1u);
    EXPECT_EQ(leave_out.rounds[0], (std::vector<Role>{Role::kTest, Role::kTest}));
  }
  for (const std::vector<Role>& round : leave_out_pairs({7, 7}, {1, 2}, {1, 1}, 2).rounds) {
    EXPECT_EQ(std::count(round.begin(), round.end(), Role::kLearn), 0) << "every clip shares the input";
  }
}

TEST(LeaveOut, OfNoClipsHasNoRounds) {
  EXPECT_TRUE(leave_out_groups({}, {}, 4).rounds.empty());
  EXPECT_TRUE(leave_out_pairs({}, {}, {}, 4).rounds.empty());
}

TEST(LeaveOut, RefusesWhatCannotBeMeant) {
  EXPECT_THROW(leave_out_groups({1}, {1, 2}, 2), InvalidArgument);
  EXPECT_THROW(leave_out_groups({1}, {1}, 0), InvalidArgument);
  EXPECT_THROW(leave_out_pairs({1}, {1, 2}, {1}, 2), InvalidArgument);
  EXPECT_THROW(leave_out_pairs({1, 2}, {1}, {1, 1}, 2), InvalidArgument);
}

TEST(LargestGap, IsWhereTheValuesFallMost) {
  const Eigen::VectorXd values = (Eigen::VectorXd(6) << 9.0, 8.0, 7.0, 0.1, 0.09, 0.01).finished();
  EXPECT_EQ(largest_gap(values, 5), 3);
  EXPECT_EQ(largest_gap(values, 2), 2) << "8 to 7 is more than 9 to 8";
  EXPECT_EQ(largest_gap(values, 0), 0);
  EXPECT_EQ(largest_gap({}, 4), 0);
  EXPECT_EQ(largest_gap(Eigen::VectorXd::Zero(4), 4), 0);
  EXPECT_EQ(largest_gap((Eigen::VectorXd(4) << 1.0, 0.5, 1e-15, 1e-30).finished(), 3), 2) << "rounding has no gaps";
  EXPECT_THROW(largest_gap(values, -1), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
