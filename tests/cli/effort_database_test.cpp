// SPDX-License-Identifier: MIT
// strut effort segment, match, labels and estimate at the command line: from clips to estimates, and what is refused.
#include "support/program.h"
#include "support/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>

namespace strut::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class EffortDatabase : public testing::Test {
 protected:
  EffortDatabase() {
    write_clip(here_.file("ann_1.bvh"), short_walk(0.0));
    write_clip(here_.file("bob_1.bvh"), short_walk(0.5));
  }
  ProgramResult effort(std::vector<std::string> words) {
    words.insert(words.begin(), "effort");
    return here_.run(STRUT_PROGRAM, std::move(words));
  }
  ProgramResult segment() {
    return effort({"segment", "@moves.db", "@ann_1.bvh", "@bob_1.bvh", "--performer", "([a-z]+)_"});
  }

  Workplace here_;
};

TEST_F(EffortDatabase, LeadsFromClipsToEstimates) {
  const ProgramResult made = segment();
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("2 clips added"), HasSubstr("next: strut effort match")));
  EXPECT_EQ(effort::FragmentDatabase::open(here_.file("moves.db")).clips().at(1).performer, "bob");
  EXPECT_THAT(segment().out, HasSubstr("2 clips were there already"));
  const ProgramResult matched = effort({"match", "@moves.db"});
  ASSERT_EQ(matched.exit_code, 0) << matched.err;
  const ProgramResult estimated = effort({"estimate", "@moves.db"});
  ASSERT_EQ(estimated.exit_code, 0) << estimated.err;
  EXPECT_GT(effort::FragmentDatabase::open(here_.file("moves.db")).counts().estimates, 0);
  EXPECT_THAT(effort({"labels", "@moves.db"}).out, HasSubstr("no labels"));
}

TEST_F(EffortDatabase, KeepsWhatAPersonSaysOfAPair) {
  ASSERT_EQ(segment().exit_code, 0);
  ASSERT_EQ(effort({"match", "@moves.db", "--reject", "2,1"}).exit_code, 0);
  ASSERT_EQ(effort({"match", "@moves.db"}).exit_code, 0);
  ASSERT_EQ(effort({"match", "@moves.db", "--list", "@pairs.csv"}).exit_code, 0);
  EXPECT_THAT(read_file(here_.file("pairs.csv")), HasSubstr("rejected by a person"));
}

TEST_F(EffortDatabase, MatchesWithinNamedActionsUnlessToldNotTo) {
  ASSERT_EQ(segment().exit_code, 0);
  effort::FragmentDatabase::open(here_.file("moves.db"), effort::Access::kReadWrite).describe_clip(1, "", "walk");
  EXPECT_THAT(effort({"match", "@moves.db"}).out, HasSubstr("1 named actions tell contents apart"));
  {
    const auto database = effort::FragmentDatabase::open(here_.file("moves.db"));
    for (const auto& a : database.fragments()) {
      for (const auto& b : database.fragments()) EXPECT_TRUE(a.action == b.action || a.group != b.group);
    }
  }
  const ProgramResult all = effort({"match", "@moves.db", "--ignore-actions"});
  EXPECT_THAT(all.out, AllOf(HasSubstr("like is what costs at most"), HasSubstr("have a partner in another clip")));
  ASSERT_EQ(effort({"match", "@moves.db", "--list", "@pairs.csv"}).exit_code, 0);
  EXPECT_THAT(read_file(here_.file("pairs.csv")), HasSubstr("share_at_limit,status,reason\n"));
}

TEST_F(EffortDatabase, RefusesInOneLineAndLeavesTheDatabaseAsItWas) {
  ASSERT_EQ(segment().exit_code, 0);
  const std::string before = read_file(here_.file("moves.db"));
  write_file(here_.file("labels.csv"), "fragment,rater,labelled_at,flow\n1,eve,2026-03-01T12:00,2\n");
  write_clip(here_.file("other.bvh"), renamed(short_walk(0.0), 4, "Tail"));
  struct Case {
    std::vector<std::string> words;
    int exit_code;
    const char* message;
  };
  for (const auto& [words, exit_code, message] : std::vector<Case>{
           {{"labels", "@moves.db", "--import", "@labels.csv"}, 3, "labels.csv:2:24: error: expected a number from -1"},
           {{"labels", "@ann_1.bvh"}, 3, "ann_1.bvh: error: expected a fragment database"},
           {{"labels", "@missing.db"}, 3, "missing.db: error: "},
           {{"segment", "@ann_1.bvh", "@bob_1.bvh"}, 3, "ann_1.bvh: error: expected a fragment database"},
           {{"segment", "@moves.db", "@moves.db"}, 3, "moves.db:"},
           {{"segment", "@moves.db", "@other.bvh"}, 4, "unknown 'Tail'"},
           {{"match", "@moves.db", "--accept", "1,999"}, 3, "expected the id of a fragment, got 999"},
           {{"match", "@moves.db", "--find", "999"}, 3, "there is no fragment 999"},
           {{"estimate", "@moves.db"}, 3, "no fragment of it belongs to a group"}}) {
    const ProgramResult result = effort(words);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_EQ(read_file(here_.file("moves.db")), before) << message;
  }
}

}  // namespace
}  // namespace strut::test
