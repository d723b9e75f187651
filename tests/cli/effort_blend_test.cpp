// SPDX-License-Identifier: MIT
// strut effort blend at the command line: what it writes and tells, and what it refuses.
#include "support/program.h"
#include "support/walks.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/math/rotation.h>
#include <strut/motion/resample.h>

namespace strut::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class EffortBlend : public testing::Test {
 protected:
  EffortBlend() {
    write_clip(here_.file("a.bvh"), first_);
    write_clip(here_.file("b.bvh"), second_);
  }
  ProgramResult blend(std::vector<std::string> options, const std::string& second = "@b.bvh") {
    options.insert(options.begin(), {"effort", "blend", "@a.bvh", second, "-o", "@out.bvh"});
    return here_.run(STRUT_PROGRAM, options);
  }
  [[nodiscard]] Motion written() const { return read_bvh(here_.file("out.bvh")).motion; }
  void expect_nothing_written() const { EXPECT_EQ(here_.entries().count("out.bvh"), 0U); }

  Motion first_ = short_walk(0.0), second_ = short_walk(0.8);
  Workplace here_;
};

TEST_F(EffortBlend, WritesABlendAndTellsOfIt) {
  const ProgramResult result = blend({"--alpha", "0.5"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NEAR(written().num_frames(), 0.5 * (first_.num_frames() + second_.num_frames()), 0.6);
  EXPECT_THAT(result.out, HasSubstr("alpha 0.5 from"));
  EXPECT_THAT(result.out, ContainsRegex("footplants; feet slide in them by 0\\.[0-9]+ cm/s, before"));
}

TEST_F(EffortBlend, EndsInItsClips) {
  ASSERT_EQ(blend({"--alpha", "0", "--no-clean-feet"}).exit_code, 0);
  EXPECT_EQ(written().num_frames(), first_.num_frames());
  constexpr double kDecimals = 1e-4;  // of angles in a file [rad]
  for (std::size_t j = 0; j < first_.frame(0).rotations.size(); ++j) {
    EXPECT_LT(written().frame(20).rotations[j].angularDistance(first_.frame(20).rotations[j]), kDecimals);
  }
  ASSERT_EQ(blend({"--alpha", "1", "--force"}).exit_code, 0);
  EXPECT_EQ(written().num_frames(), second_.num_frames());
}

TEST_F(EffortBlend, LeavesFeetAloneIfAskedTo) {
  const ProgramResult result = blend({"--alpha", "0.5", "--no-clean-feet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("before they were held")));
}

TEST_F(EffortBlend, SaysHowTimeGoesOnFarOut) {
  const ProgramResult result = blend({"--alpha", "-1.9"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("rates change by constant factors"));
}

TEST_F(EffortBlend, BringsTheSecondToTheFirstsRate) {
  write_clip(here_.file("fine.bvh"), motion::resample(second_, 60.0));
  const ProgramResult result = blend({"--alpha", "0.5"}, "@fine.bvh");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("resampled from 60 to 30 frames/s"));
}

TEST_F(EffortBlend, RefusesArgumentsThatMakeNoSense) {
  for (const char* alpha : {"nan", "inf", "-2.1", "3.01", "much"}) {
    const ProgramResult result = blend({"--alpha", alpha});
    EXPECT_EQ(result.exit_code, 2) << alpha;
    EXPECT_THAT(result.err, HasSubstr("--alpha")) << alpha;
  }
  EXPECT_EQ(blend({}).exit_code, 2) << "no alpha";
  EXPECT_EQ(blend({"--alpha", "0.5", "--slope-limit", "1"}).exit_code, 2);
  const ProgramResult nowhere = here_.run(STRUT_PROGRAM, {"effort", "blend", "@a.bvh", "@b.bvh", "--alpha", "0.5"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("--output"));
  expect_nothing_written();
}

TEST_F(EffortBlend, RefusesClipsThatDoNotFit) {
  write_clip(here_.file("beak.bvh"), renamed(second_, 3, "Beak"));
  const ProgramResult other = blend({"--alpha", "0.5"}, "@beak.bvh");
  EXPECT_EQ(other.exit_code, 4);
  EXPECT_THAT(other.err, HasSubstr("Beak"));
  write_clip(here_.file("short.bvh"), second_.slice(0, 30));
  const ProgramResult brief = blend({"--alpha", "0.5"}, "@short.bvh");
  EXPECT_EQ(brief.exit_code, 3);
  EXPECT_THAT(brief.err, ContainsRegex("short.bvh: error: expected a fragment at most 2.* times as long"));
  write_clip(here_.file("frame.bvh"), second_.slice(0, 2));
  EXPECT_THAT(blend({"--alpha", "0.5"}, "@frame.bvh").err, HasSubstr("at least 4 frames"));
  EXPECT_EQ(blend({"--alpha", "0.5"}, "@missing.bvh").exit_code, 3);
  std::vector<Pose> turned = second_.frames();
  for (Pose& pose : turned) pose.rotations[5] = pose.rotations[5] * math::exp_map({0.0, 2.6, 0.0});
  write_clip(here_.file("turned.bvh"), Motion(second_.shared_skeleton(), second_.frame_rate(), turned));
  const ProgramResult apart = blend({"--alpha", "0.5"}, "@turned.bvh");
  EXPECT_EQ(apart.exit_code, 3);
  EXPECT_THAT(apart.err, HasSubstr(second_.skeleton().joint(5).name + ", 1"));
  expect_nothing_written();
}

TEST_F(EffortBlend, LeavesFilesThatAreThereAlone) {
  ASSERT_EQ(blend({"--alpha", "0.5"}).exit_code, 0);
  const std::string before = read_file(here_.file("out.bvh"));
  EXPECT_EQ(blend({"--alpha", "0.7"}).exit_code, 1);
  EXPECT_EQ(read_file(here_.file("out.bvh")), before);
  EXPECT_EQ(
      here_.run(STRUT_PROGRAM, {"effort", "blend", "@a.bvh", "@b.bvh", "--alpha", "0.5", "-o", "@a.bvh", "--force"})
          .exit_code,
      1)
      << "its own input";
}

}  // namespace
}  // namespace strut::test
