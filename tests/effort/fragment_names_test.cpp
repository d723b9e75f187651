// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/walks.h"

#include <gtest/gtest.h>

#include <strut/effort/fragment_names.h>

namespace strut::effort {
namespace {

TEST(FragmentNames, AreShortUnlessClipsShareThem) {
  const test::TemporaryFolder folder;
  const Motion walk = test::short_walk(0.0);
  auto database = FragmentDatabase::create(folder.file("moves.db"), walk.shared_skeleton(), walk.frame_rate());
  for (const char* clip : {"a/long/way/raise_001.bvh", "mia/run.bvh", "tom/run.bvh", "take.2"}) {
    database.add_clip({clip, "", ""}, walk, {{0, 20}});
  }
  const auto names = fragment_names(database);
  ASSERT_EQ(names.size(), 4U);
  EXPECT_EQ(names.at(1), "raise_001 frames 0-20");
  EXPECT_EQ(names.at(2), "mia/run.bvh frames 0-20");
  EXPECT_EQ(names.at(3), "tom/run.bvh frames 0-20");
  EXPECT_EQ(names.at(4), "take.2 frames 0-20");
}

}  // namespace
}  // namespace strut::effort
