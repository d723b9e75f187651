// SPDX-License-Identifier: MIT
// strut view: what its server answers, and to whom.
#include "support/program.h"
#include "support/walks.h"
#include "view_session.h"

#include <csignal>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strut::test {
namespace {

class View : public testing::Test {
 protected:
  View() { write_clip(here_.file("walk.bvh"), walk_); }

  Workplace here_;
  Motion walk_ = short_walk(0.0);
};

TEST_F(View, TellsWhichFilesItHas) {
  const ViewSession session({here_.file("walk.bvh")});
  const nlohmann::json files = session.json("session").at("files");
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].at("kind"), "clip");
  EXPECT_EQ(files[0].at("name"), "walk.bvh");
}

TEST_F(View, SendsAClip) {
  const ViewSession session({here_.file("walk.bvh")});
  const ViewContainer clip = session.container("clips/c0");
  const std::size_t points = clip.header.at("points").size();
  EXPECT_EQ(clip.header.at("numFrames"), walk_.num_frames());
  EXPECT_EQ(clip.arrays.at("positions").size(), points * 3U * static_cast<std::size_t>(walk_.num_frames()));
}

TEST_F(View, IsGoneOnceKilled) {
  ViewSession session({here_.file("walk.bvh")});
  EXPECT_EQ(session.get("session").status, 200);
  session.kill();
  EXPECT_EQ(session.get("session").status, 0);
}

}  // namespace
}  // namespace strut::test
