// SPDX-License-Identifier: MIT
#include "small_gaits.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>

namespace strut::blend {
namespace {

using test::small_examples;
using test::styled_walk;
using test::walks_and_truth;

TEST(GaitExamples, MeasuresSpeeds) {
  const GaitExamples examples = small_examples();
  ASSERT_EQ(examples.cells.size(), 12U);
  constexpr double kPlain[] = {0.6, 0.9, 1.2, 1.5};
  for (int k = 0; k < 4; ++k) {
    const GaitCell& cell = examples.cells[static_cast<std::size_t>(k)];
    EXPECT_NEAR(cell.speed / kPlain[k], 1.0, 0.03) << "steps vary by 2 % in length and in time";
    EXPECT_NEAR(cell.loop.velocity().norm() / cell.speed, 1.0, 0.02);
    EXPECT_GE(cell.num_cycles, 3);
  }
}

TEST(GaitExamples, PutsOneMomentAtOnePhaseInAll) {
  // Both feet alternate, so that the right foot comes down half a cycle after the left, whatever style and speed.
  for (const GaitCell& cell : small_examples().cells) {
    EXPECT_NEAR(cell.loop.plants()[1].begin - cell.loop.plants()[0].begin, 0.5, 0.03);
    EXPECT_NEAR(cell.loop.plants()[0].begin, 0.0, 0.15);
    EXPECT_GT(cell.loop.plants()[0].end - cell.loop.plants()[0].begin, 0.3);
  }
}

TEST(GaitExamples, ClosesCycles) {
  constexpr double kClosed = 1e-3;
  for (const GaitCell& cell : small_examples().cells) {
    const GaitLoop& loop = cell.loop;
    EXPECT_LT((loop.at(1.0) - loop.at(0.0)).cwiseAbs().maxCoeff(), kClosed);
    EXPECT_LT((loop.rate_at(1.0) * loop.pace(1.0) - loop.rate_at(0.0) * loop.pace(0.0)).cwiseAbs().maxCoeff(), kClosed);
  }
}

TEST(GaitExamples, RefusesClipsWithoutGait) {
  EXPECT_THROW(gait_examples({}), InvalidArgument);
  const StyledClip walk = styled_walk("plain", 1.2, 1.0, 4.0);
  EXPECT_THROW(gait_examples({{"", walk.motion, ""}}), InvalidArgument);
  Diagnostics told;
  const StyledClip stands{"still", walk.motion.slice(0, 20), "still.bvh"};
  EXPECT_THROW(gait_examples({walk, stands}, {}, &told), InvalidArgument);
  ASSERT_FALSE(told.entries().empty());
  EXPECT_EQ(told.entries().back().where, "still.bvh");
  EXPECT_THROW(gait_examples({walk}, {.harmonics = 0}), InvalidArgument);
}

}  // namespace
}  // namespace strut::blend
