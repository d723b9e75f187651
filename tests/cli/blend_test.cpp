// SPDX-License-Identifier: MIT
// strut blend at the command line: what it learns, shows and makes, and what it refuses.
#include "support/program.h"
#include "support/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::Not;

Motion walk(double speed, double crouch) {
  generate::WalkContent content;
  content.duration = 6.0;
  content.speed = speed;
  generate::WalkStyle style;
  style.crouch = crouch;
  return generate::generate_walk(content, style, 30.0).motion;
}

class BlendCommand : public testing::Test {
 protected:
  BlendCommand() {
    for (const auto& [name, speed] : {std::pair{"slow", 0.8}, std::pair{"quick", 1.3}}) {
      write_clip(here_.file(std::string("plain_") + name + ".bvh"), walk(speed, 0.0));
      write_clip(here_.file(std::string("low_") + name + ".bvh"), walk(speed, 0.2));
    }
  }
  ProgramResult blend(std::vector<std::string> options) {
    options.insert(options.begin(), "blend");
    return here_.run(STRUT_PROGRAM, options);
  }
  ProgramResult learn() {
    return blend({"@gaits", "--learn", "plain=", "@plain_slow.bvh", "@plain_quick.bvh", "low=", "@low_slow.bvh",
                  "@low_quick.bvh"});
  }

  Workplace here_;
};

TEST_F(BlendCommand, LearnsShowsAndMakes) {
  const ProgramResult learnt = learn();
  ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
  EXPECT_THAT(learnt.out, HasSubstr("Left out and predicted"));
  const ProgramResult shown = blend({"@gaits"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_EQ(shown.out, learnt.out);
  EXPECT_EQ(here_.run(STRUT_PROGRAM, {"info", "@gaits"}).out, learnt.out);
  EXPECT_THAT(here_.run(STRUT_PROGRAM, {"info", "--json", "@gaits"}).out, HasSubstr("\"kind\": \"gait model\""));
  const ProgramResult confused = here_.run(STRUT_PROGRAM, {"align", "@gaits", "@plain_slow.bvh"});
  EXPECT_EQ(confused.exit_code, 3);
  EXPECT_THAT(confused.err, HasSubstr("expected a BVH file, which is text, found a binary file, as models are"));
  const ProgramResult made = blend(
      {"@gaits", "--style", "plain=0.5", "--style", "low=0.5", "--speed", "1.0", "--seconds", "5", "-o", "@out.bvh"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(read_bvh(here_.file("out.bvh")).motion.num_frames(), 150);
  const ProgramResult cycle = blend({"@gaits", "--style", "low", "--speed", "1.0", "--cycle", "-o", "@cycle.bvh"});
  ASSERT_EQ(cycle.exit_code, 0) << cycle.err;
  EXPECT_THAT(cycle.out, HasSubstr("loops"));
}

TEST_F(BlendCommand, FollowsKeys) {
  ASSERT_EQ(learn().exit_code, 0);
  write_file(here_.file("keys.csv"),
             "time_s,speed_m_per_s,turn_rate_rad_per_s,low,plain\n0,0.8,0,1,0\n2,1.2,0.3,0.2,0.8\n4,1.0,0,0,1\n");
  const ProgramResult made = blend({"@gaits", "--keys", "@keys.csv", "-o", "@out.bvh"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(read_bvh(here_.file("out.bvh")).motion.num_frames(), 120);
}

TEST_F(BlendCommand, SaysWhatIsWrongWithKeys) {
  ASSERT_EQ(learn().exit_code, 0);
  const std::pair<const char*, const char*> cases[] = {
      {"time_s,speed_m_per_s,plain\n1,1,1\n1,1,1\n", "keys.csv:3:1: error: expected a time after 1 s, found 1"},
      {"time_s,speed_m_per_s,plain\n1,-1,1\n", "expected a speed above 0, found -1"},
      {"time_s,speed_m_per_s,plain\n1,nan,1\n", "expected a finite number"},
      {"time_s,speed_m_per_s,plain\n1,1,0.5\n", "weights of the styles that sum to 1"},
      {"time_s,speed_m_per_s,proud\n1,1,1\n", "'proud'"},
      {"time_s,speed_m_per_s\n1,1\n", "a column for every style"}};
  for (const auto& [text, message] : cases) {
    write_file(here_.file("keys.csv"), text, Overwrite::kAllow);
    const ProgramResult result = blend({"@gaits", "--keys", "@keys.csv", "-o", "@out.bvh"});
    EXPECT_EQ(result.exit_code, 3) << text;
    EXPECT_THAT(result.err, HasSubstr(message));
  }
  EXPECT_EQ(here_.entries().count("out.bvh"), 0U);
}

TEST_F(BlendCommand, RefusesStylesAndSpeedsThatMakeNoSense) {
  ASSERT_EQ(learn().exit_code, 0);
  const auto make = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "@gaits");
    words.insert(words.end(), {"-o", "@out.bvh"});
    return blend(words);
  };
  EXPECT_THAT(make({"--style", "proud", "--speed", "1"}).err, HasSubstr("its styles are: plain, low"));
  EXPECT_EQ(make({"--style", "proud", "--speed", "1"}).exit_code, 3);
  EXPECT_THAT(make({"--style", "plain=0.5", "--speed", "1"}).err, HasSubstr("sum to 1"));
  EXPECT_EQ(make({"--style", "plain=0.5", "--speed", "1"}).exit_code, 2);
  EXPECT_EQ(make({"--style", "plain=x", "--speed", "1"}).exit_code, 2);
  EXPECT_EQ(make({"--style", "plain", "--speed", "-1"}).exit_code, 2);
  EXPECT_EQ(make({"--style", "plain"}).exit_code, 2);
  EXPECT_EQ(make({"--style", "plain", "--speed", "1", "--learn", "plain=", "@plain_slow.bvh"}).exit_code, 2);
  const ProgramResult absurd = make({"--style", "plain", "--speed", "15"});
  EXPECT_EQ(absurd.exit_code, 1);
  EXPECT_THAT(absurd.err, HasSubstr("stay nearer"));
  const ProgramResult beyond = make({"--style", "plain", "--speed", "1.7"});
  EXPECT_EQ(beyond.exit_code, 0) << beyond.err;
  EXPECT_THAT(beyond.err, HasSubstr("faster than the examples"));
}

TEST_F(BlendCommand, RefusesClipsItCannotLearnFrom) {
  const ProgramResult one = blend({"@gaits", "--learn", "plain=", "@plain_slow.bvh"});
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_THAT(one.err, HasSubstr("two styles"));
  EXPECT_EQ(blend({"@gaits", "--learn", "@plain_slow.bvh"}).exit_code, 2);
  write_clip(here_.file("still.bvh"), held(walk(1.0, 0.0), 60));
  const ProgramResult still = blend({"@gaits", "--learn", "plain=", "@plain_slow.bvh", "still=", "@still.bvh"});
  EXPECT_EQ(still.exit_code, 1);
  EXPECT_THAT(still.err, HasSubstr("'still'"));
  write_clip(here_.file("other.bvh"), renamed(walk(1.0, 0.0), 3, "Beak"));
  const ProgramResult other = blend({"@gaits", "--learn", "plain=", "@plain_slow.bvh", "other=", "@other.bvh"});
  EXPECT_EQ(other.exit_code, 4);
  EXPECT_THAT(other.err, HasSubstr("Beak"));
  EXPECT_EQ(here_.entries().count("gaits"), 0U);
}

TEST_F(BlendCommand, LeavesFilesThatAreThereAlone) {
  ASSERT_EQ(learn().exit_code, 0);
  const std::string before = read_file(here_.file("gaits"));
  EXPECT_EQ(learn().exit_code, 1);
  EXPECT_EQ(read_file(here_.file("gaits")), before);
  const ProgramResult onto =
      blend({"@plain_slow.bvh", "--force", "--learn", "plain=", "@plain_slow.bvh", "low=", "@low_slow.bvh"});
  EXPECT_EQ(onto.exit_code, 1) << "its own input";
  const ProgramResult bad = blend({"@plain_slow.bvh"});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.err, HasSubstr("a gait model made by strut blend"));
}

}  // namespace
}  // namespace strut::test
