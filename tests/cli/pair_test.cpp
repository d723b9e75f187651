// SPDX-License-Identifier: MIT
// strut pair at the command line: what it makes of good clips, and how it refuses others.
#include "support/program.h"
#include "support/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/pair_list.h>

namespace strut::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class PairCommand : public testing::Test {
 protected:
  PairCommand() {
    write_clip(here_.file("normal.bvh"), normal_);
    write_clip(here_.file("limp.bvh"), limp_);
  }
  ProgramResult pair(const std::string& input, const std::string& output, const std::string& list = "@pairs.toml",
                     const std::string& more = "--whole=false") {
    return here_.run(STRUT_PROGRAM, {"pair", "--input", input, "--output", output, "-o", list, more});
  }
  [[nodiscard]] bool made_nothing() const { return here_.entries().count("pairs.toml") == 0; }

  Workplace here_;
  Motion normal_ = short_walk(0.0), limp_ = short_walk(0.8);
};

TEST_F(PairCommand, WritesAListOfThePairsItTellsOf) {
  const ProgramResult result = pair("@normal.bvh", "@limp.bvh");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("gait cycles"), HasSubstr("0 refused")));
  const auto pairs = read_pair_list(here_.file("pairs.toml"));
  ASSERT_FALSE(pairs.empty());
  EXPECT_EQ(pairs.front().input.path, here_.file("normal.bvh"));
  EXPECT_THAT(here_.entries(), ElementsAre("limp.bvh", "normal.bvh", "pairs.toml"));
}

TEST_F(PairCommand, SaysOnceWhatHoldsOfManyFiles) {
  const ProgramResult result = pair("@normal.bvh", "@limp.bvh");
  EXPECT_THAT(result.err,
              HasSubstr("normal.bvh and " + here_.file("limp.bvh") + ": note: lengths read as centimetres"));
  EXPECT_EQ(result.err.find("note:"), result.err.rfind("note:"));
}

TEST_F(PairCommand, TakesNamesWithSpacesColonsAndOtherLetters) {
  write_clip(here_.file("a b:\xc3\xbc.bvh"), normal_);
  ASSERT_EQ(pair("@a b:\xc3\xbc.bvh", "@limp.bvh").exit_code, 0);
  EXPECT_EQ(read_pair_list(here_.file("pairs.toml")).front().input.path, here_.file("a b:\xc3\xbc.bvh"));
}

TEST_F(PairCommand, RefusesClipsTooShortOrWithoutMovement) {
  write_clip(here_.file("brief.bvh"), normal_.slice(0, 5));
  write_clip(here_.file("still.bvh"), held(normal_, 60));
  for (const auto& [clip, reason] :
       {std::pair("brief.bvh", "it has 5 frames, shorter than 0.2 s"), std::pair("still.bvh", "nothing moves in it")}) {
    const ProgramResult result = pair("@" + std::string(clip), "@limp.bvh");
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, AllOf(HasSubstr(std::string(clip) + ": warning: left out: " + reason),
                                  HasSubstr(std::string(clip) + ": error: no pair could be made")));
    EXPECT_TRUE(made_nothing());
  }
}

TEST_F(PairCommand, NamesTheClipOfAnotherSkeleton) {
  write_clip(here_.file("other.bvh"), renamed(limp_, 4, "Tail"));
  const ProgramResult result = pair("@normal.bvh", "@other.bvh");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, AllOf(HasSubstr("other.bvh: error: not the skeleton of " + here_.file("normal.bvh")),
                                HasSubstr("unknown 'Tail'"), Not(HasSubstr("note:"))));
  EXPECT_TRUE(made_nothing());
}

TEST_F(PairCommand, DoesNotOverwriteItsOwnClipsEvenIfForced) {
  const std::string before = read_file(here_.file("normal.bvh"));
  const ProgramResult result = pair("@normal.bvh", "@limp.bvh", "@normal.bvh", "--force");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("normal.bvh: error: is needed as"));
  EXPECT_EQ(read_file(here_.file("normal.bvh")), before);
}

TEST_F(PairCommand, DoesNotOverwriteUnasked) {
  write_file(here_.file("pairs.toml"), "mine");
  EXPECT_EQ(pair("@normal.bvh", "@limp.bvh").exit_code, 1);
  EXPECT_EQ(read_file(here_.file("pairs.toml")), "mine");
  EXPECT_EQ(pair("@normal.bvh", "@limp.bvh", "@pairs.toml", "--force").exit_code, 0);
}

}  // namespace
}  // namespace strut::test
