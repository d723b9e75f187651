// SPDX-License-Identifier: MIT
// strut clean at the command line: what it writes and tells, where footplants come from, and what it refuses.
#include "support/program.h"
#include "support/walks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/metrics/foot_slide.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double kWrittenStill =
    1e-3;  // slide of held feet as a file's decimals give it [m/s]; measured: 4e-4, of legs that may not stretch

/// A walk whose pelvis moves to and fro.
Motion sliding_walk() {
  const Motion walk = short_walk(0.0, 3.0);
  std::vector<Pose> frames = walk.frames();
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].translations[0].z() += 0.02 * std::sin(2.0 * std::numbers::pi * static_cast<double>(f) / 30.0);
  }
  return {walk.shared_skeleton(), walk.frame_rate(), std::move(frames)};
}

class CleanCommand : public testing::Test {
 protected:
  CleanCommand() { write_clip(here_.file("walk.bvh"), walk_); }
  ProgramResult clean(std::vector<std::string> options = {}, const std::string& clip = "@walk.bvh") {
    options.insert(options.begin(), {"clean", clip, "-o", "@out.bvh"});
    return here_.run(STRUT_PROGRAM, options);
  }
  [[nodiscard]] std::vector<motion::Footplant> plants() const {
    return postprocess::detect_footplants(walk_, motion::find_legs(walk_).value());
  }
  [[nodiscard]] double slide_of(const std::string& file, const std::vector<motion::Footplant>& plants) const {
    return metrics::foot_slide(metrics::body_track(read_bvh(here_.file(file)).motion, 30.0), plants).speed;
  }

  Workplace here_;
  Motion walk_ = sliding_walk();
};

TEST_F(CleanCommand, WritesAClipWhoseFeetStandAndTellsHowFarTheySlid) {
  const ProgramResult result = clean();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ContainsRegex("feet slide in footplants by 0\\.0[0-9] cm/s, before [1-9]"));
  EXPECT_THAT(result.out, ContainsRegex("feet moved by at most [0-9.]+ cm: the (left|right) at frame [0-9]+"));
  EXPECT_GT(slide_of("walk.bvh", plants()), 0.02);
  EXPECT_LT(slide_of("out.bvh", plants()), kWrittenStill);
  EXPECT_THAT(here_.entries(), ElementsAre("out.bvh", "walk.bvh"));
}

TEST_F(CleanCommand, WritesAllThatItChanges) {
  EXPECT_THAT(clean().err, Not(HasSubstr("no channels")));
  EXPECT_THAT(clean({"--keep-layout", "--force"}).err, Not(HasSubstr("no channels")));
}

TEST_F(CleanCommand, StretchesBonesWhereTheLayoutHoldsIt) {
  BvhLayout layout = default_layout(walk_.skeleton());
  std::fill(layout.channels.begin() + 1, layout.channels.end(), layout.channels[0]);
  std::vector<Pose> frames = walk_.frames();
  for (Pose& pose : frames) pose.translations[0].y() += 0.03;  // legs do not reach their feet's places
  write_bvh(here_.file("walk.bvh"), Motion(walk_.shared_skeleton(), 30.0, std::move(frames)), layout,
            Overwrite::kAllow);
  ASSERT_EQ(clean({"--keep-layout"}).exit_code, 0);
  const BvhClip kept = read_bvh(here_.file("out.bvh"));
  EXPECT_EQ(kept.layout.channels, layout.channels);
  EXPECT_THAT(clean({"--force"}).err, Not(HasSubstr("no channels")));
}

TEST_F(CleanCommand, TakesFootplantsFromATable) {
  std::string table = "clip,foot,begin,end\nother.bvh,left,0,1000\n";
  for (const auto& plant : plants()) {
    table += std::string("walk.bvh,") + (plant.foot == 0 ? "left," : "right,") + std::to_string(plant.begin) + "," +
             std::to_string(plant.end) + "\n";
  }
  write_file(here_.file("plants.csv"), table);
  ASSERT_EQ(clean({"--footplants", "@plants.csv"}).exit_code, 0);
  const std::string with_table = read_file(here_.file("out.bvh"));
  ASSERT_EQ(clean({"--force"}).exit_code, 0);
  EXPECT_EQ(read_file(here_.file("out.bvh")), with_table);
}

TEST_F(CleanCommand, TakesTheTableOfStrutFootplants) {
  const ProgramResult listed = here_.run(STRUT_PROGRAM, {"footplants", "@walk.bvh", "--csv"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  write_file(here_.file("plants.csv"), listed.out);
  const ProgramResult result = clean({"--footplants", "@plants.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(slide_of("out.bvh", plants()), kWrittenStill);
}

TEST_F(CleanCommand, TakesTheFeetItIsTold) {
  ASSERT_EQ(clean({"--feet", "LeftFoot,RightFoot"}).exit_code, 0);
  EXPECT_THAT(clean({"--feet", "Nose,RightFoot", "--force"}).err, HasSubstr("--feet"));
}

TEST_F(CleanCommand, RefusesTablesThatDoNotFitTheClip) {
  for (const auto& [rows, message] : std::vector<std::pair<std::string, std::string>>{
           {"other.bvh,left,0,10\n", "no footplants of"},
           {"walk.bvh,middle,0,10\n", "plants.csv:2:10: error: expected left or right, found 'middle'"},
           {"walk.bvh,left,0,1000\n", "expected a frame from 1 to 90, found 1000"},
           {"walk.bvh,left,5,5\n", "expected a frame from 6 to 90, found 5"},
           {"walk.bvh,left,1e99,2e99\n", "expected a frame from 0 to 89"},
           {"walk.bvh,left,0.5,10\n", "expected a frame from 0 to 89, found 0.5"}}) {
    write_file(here_.file("plants.csv"), "clip,foot,begin,end\n" + rows, Overwrite::kAllow);
    const ProgramResult result = clean({"--footplants", "@plants.csv"});
    EXPECT_EQ(result.exit_code, 3) << rows;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_EQ(here_.entries().count("out.bvh"), 0U);
  }
}

TEST_F(CleanCommand, RefusesClipsItCannotClean) {
  write_clip(here_.file("still.bvh"), held(walk_, 1));
  EXPECT_THAT(clean({}, "@still.bvh").err, HasSubstr("at least two frames"));
  EXPECT_EQ(clean({}, test_file("data/two_joints.bvh")).exit_code, 3);
  EXPECT_EQ(clean({}, "@no_such.bvh").exit_code, 3);
}

TEST_F(CleanCommand, OverwritesOnlyWhenForced) {
  ASSERT_EQ(clean().exit_code, 0);
  EXPECT_EQ(clean().exit_code, 1);
  EXPECT_EQ(clean({"--force"}).exit_code, 0);
}

}  // namespace
}  // namespace strut::test
