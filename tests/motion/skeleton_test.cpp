// SPDX-License-Identifier: MIT
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/motion/skeleton.h>

namespace strut {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Joint joint(const char* name, int parent) {
  Joint result;
  result.name = name;
  result.parent = parent;
  return result;
}

/// A carrier above a pelvis with two legs and a spine.
std::vector<Joint> body() {
  return {joint("carrier", -1), joint("hips", 0),  joint("left", 1),
          joint("right", 1),    joint("spine", 1), joint("head", 4)};
}

std::string message_of(std::vector<Joint> joints) {
  try {
    const Skeleton skeleton(std::move(joints));
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

TEST(Skeleton, KnowsItsChildrenAndNames) {
  const Skeleton skeleton(body());
  EXPECT_EQ(skeleton.num_joints(), 6);
  EXPECT_THAT(skeleton.children(0), ElementsAre(1));
  EXPECT_THAT(skeleton.children(1), ElementsAre(2, 3, 4));
  EXPECT_THAT(skeleton.children(5), IsEmpty());
  EXPECT_EQ(skeleton.find("spine"), 4);
  EXPECT_EQ(skeleton.find("Spine"), -1);
  EXPECT_THROW((void)skeleton.joint(6), std::out_of_range);
}

TEST(Skeleton, FindsTheFirstOfARepeatedName) {
  EXPECT_EQ(Skeleton({joint("a", -1), joint("b", 0), joint("b", 0)}).find("b"), 1);
}

TEST(Skeleton, TakesTheFirstBranchForThePelvis) {
  EXPECT_EQ(Skeleton(body()).pelvis(), 1);
  EXPECT_EQ(Skeleton({joint("a", -1), joint("b", 0), joint("c", 0)}).pelvis(), 0);
  EXPECT_EQ(Skeleton({joint("tail", -1), joint("tail", 0), joint("tail", 1)}).pelvis(), 2) << "a chain ends";
}

TEST(Skeleton, RefusesWhatIsNoTree) {
  EXPECT_EQ(message_of({}), "joints: expected at least one joint, got none");
  EXPECT_EQ(message_of({joint("a", 0)}), "joints[0].parent: expected -1 (the root comes first), got another joint");
  EXPECT_EQ(message_of({joint("a", -1), joint("b", -1)}),
            "joints[1].parent: expected a joint that precedes it, got -1");
  EXPECT_EQ(message_of({joint("a", -1), joint("b", 1)}), "joints[1].parent: expected a joint that precedes it, got 1");
}

TEST(Skeleton, RefusesOffsetsThatAreNotNumbers) {
  auto joints = body();
  joints[2].offset.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of(joints), "joints[2].offset: expected finite numbers, got NaN or infinity");
  joints = body();
  joints[5].end_site.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message_of(joints), "joints[5].offset: expected finite numbers, got NaN or infinity");
}

TEST(DescribeMismatch, IsEmptyForTheSameHierarchyWithOtherBones) {
  auto longer = body();
  longer[2].offset = {0.0, -1.0, 0.0};
  EXPECT_EQ(describe_mismatch(Skeleton(body()), Skeleton(longer)), "");
}

TEST(DescribeMismatch, NamesMissingAndUnknownJoints) {
  auto other = body();
  other[5].name = "skull";
  EXPECT_EQ(describe_mismatch(Skeleton(body()), Skeleton(other)), "missing 'head'; unknown 'skull'");
}

TEST(DescribeMismatch, NamesNoMoreThanFive) {
  std::vector<Joint> many = {joint("carrier", -1)};
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g"}) many.push_back(joint(name, 0));
  EXPECT_EQ(describe_mismatch(Skeleton(many), Skeleton({joint("carrier", -1)})),
            "missing 'a', 'b', 'c', 'd', 'e', and 2 more");
}

TEST(DescribeMismatch, SeesAnotherParentOrderOrCount) {
  auto moved = body();
  moved[5].parent = 1;
  EXPECT_EQ(describe_mismatch(Skeleton(body()), Skeleton(moved)), "'head' hangs on 'hips' instead of 'spine'");
  auto swapped = body();
  std::swap(swapped[2].name, swapped[3].name);
  EXPECT_EQ(describe_mismatch(Skeleton(body()), Skeleton(swapped)), "joint 2 is 'right' instead of 'left'");
  auto doubled = body();
  doubled.push_back(joint("head", 4));
  EXPECT_EQ(describe_mismatch(Skeleton(body()), Skeleton(doubled)), "7 joints instead of 6");
}

}  // namespace
}  // namespace strut
