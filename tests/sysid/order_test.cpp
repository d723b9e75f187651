// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

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
