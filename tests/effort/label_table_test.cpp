// SPDX-License-Identifier: MIT
// Labels and cuts as tables: what goes out comes back, and a table with anything wrong in it changes nothing.
#include "support/data.h"
#include "support/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/effort/cut_table.h>
#include <strut/effort/label_table.h>

namespace strut::test {
namespace {

using namespace effort;
using testing::HasSubstr;

class LabelTable : public testing::Test {
 protected:
  LabelTable() : database_(made("moves.db")) {}

  FragmentDatabase made(const std::string& name) {
    const Motion walk = short_walk(0.0);
    FragmentDatabase database = FragmentDatabase::create(here_.file(name), walk.shared_skeleton(), walk.frame_rate());
    database.add_clip({"a,b.bvh", "ann", "walk"}, walk, {{0, 20}, {20, 50}, {60, 90}});
    database.set_matching({{1, 0}, {2, 0}}, {{1, 2, 0.1, 0.0, PairStatus::kAccepted}});
    return database;
  }
  LabelImport take(const std::string& text) {
    write_file(here_.file("labels.csv"), text, Overwrite::kAllow);
    return import_labels(database_, here_.file("labels.csv"));
  }
  void expect_refused(const std::string& text, const std::string& message) {
    const std::string before = read_file(here_.file("moves.db"));
    try {
      take(text);
      ADD_FAILURE() << "taken: " << text;
    } catch (const ParseError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
    EXPECT_EQ(read_file(here_.file("moves.db")), before);
  }

  TemporaryFolder here_;
  FragmentDatabase database_;
};

constexpr const char* kAll =
    "fragment,clip,begin_frame,end_frame,first,second,alpha,rater,labelled_at,source,flow,weight,time,space,repeat,"
    "comment\n"
    "1,\"a,b.bvh\",0,20,,,,eve,2026-03-01T12:00:00Z,person,0.5,not present,,-1,0,\"says \"\"no\"\", then stops\"\n"
    ",,,,1,2,1.25,kim,2026-03-01T12:00:00Z,synthetic,0.1,0.2,0.3,,1,\n";

TEST_F(LabelTable, ComesBackAsItWent) {
  EXPECT_EQ(take(kAll).added, 2);
  EXPECT_EQ(format_labels(database_), kAll);
  EXPECT_EQ(take(kAll).repeated, 2);
  EXPECT_EQ(format_labels(database_), kAll);
}

TEST_F(LabelTable, FindsFragmentsByClipAndFrames) {
  EXPECT_EQ(take("clip,begin_frame,end_frame,rater,labelled_at,time\n\"a,b.bvh\",20,50,eve,2026-03-01 12:00,1\n").added,
            1);
  EXPECT_EQ(database_.labels().front().target.id, 2);
}

TEST_F(LabelTable, NeverTakesEstimatesForLabels) {
  database_.set_estimates({{1, {0.1, 0.2, 0.3}, {1, 1, 1}}});
  const std::string text = format_labels(database_, true);
  EXPECT_THAT(text, HasSubstr(",estimate,0.1,0.2,0.3,"));
  EXPECT_EQ(take(text).estimates, 1);
  EXPECT_TRUE(database_.labels().empty());
}

TEST_F(LabelTable, SaysWhatIsWrongWhereAndChangesNothing) {
  const std::string names = "fragment,first,second,alpha,rater,labelled_at,source,flow\n";
  const std::string good = "1,,,,eve,2026-03-01T12:00:00Z,person,0.5\n,1,2,0.5,eve,2026-03-01T12:00:00Z,person,0.5\n";
  const auto refused = [&](const std::string& row, const std::string& message) {
    expect_refused(names + good + row + "\n", message);
  };
  refused("1,,,,kim,2026-03-01T12:00:00Z,person,1.5", "labels.csv:4:38: error: expected a number from -1 to 1");
  refused("1,,,,kim,2026-03-01T12:00:00Z,person,nan", ":4:38: error: expected a finite number, found 'nan'");
  refused("9,,,,kim,2026-03-01T12:00:00Z,person,0", ":4:1: error: expected a fragment of the database, found 9");
  refused("1,,,,,2026-03-01T12:00:00Z,person,0", ":4:6: error: expected who labelled it");
  refused("1,,,,kim,yesterday,person,0", ":4:10: error: expected a time as");
  refused("1,,,,kim,2026-03-01T12:00:00Z,person,", ":4: error: expected at least one factor");
  refused("1,,,,kim,2026-03-01T12:00:00Z,guess,0", ":4:31: error: expected person, synthetic or estimate");
  refused(",1,3,0.5,kim,2026-03-01T12:00:00Z,person,0", ":4:2: error: expected an accepted pair");
  refused(",,,,kim,2026-03-01T12:00:00Z,person,0", ":4:1: error: expected a fragment");
  expect_refused("fragment,labelled_at,flow\n1,2026-03-01T12:00:00Z,0\n", "expected a column named 'rater'");
}

TEST_F(LabelTable, CutsComeBackAsTheyWentAndKeepLabels) {
  take(kAll);
  const std::string cuts = format_cuts(database_);
  write_file(here_.file("cuts.csv"), cuts);
  EXPECT_EQ(import_cuts(database_, here_.file("cuts.csv")), 1);
  EXPECT_EQ(format_cuts(database_), cuts);
  EXPECT_EQ(database_.labels().size(), 2U);
}

TEST_F(LabelTable, CutsThatLoseLabelsOverlapOrLeaveTheClipAreRefused) {
  take(kAll);
  const std::string before = read_file(here_.file("moves.db"));
  const auto refusal = [&](const std::string& rows) {
    write_file(here_.file("cuts.csv"), "clip,begin_frame,end_frame\n" + rows, Overwrite::kAllow);
    try {
      import_cuts(database_, here_.file("cuts.csv"));
    } catch (const ParseError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_THAT(refusal("\"a,b.bvh\",0,21\n"), HasSubstr("none for fragment 1 (a,b.bvh 0 to 20), 2"));
  EXPECT_THAT(refusal("\"a,b.bvh\",0,20\n\"a,b.bvh\",19,50\n"), HasSubstr("do not overlap those of line 2"));
  EXPECT_THAT(refusal("\"a,b.bvh\",0,2000\n"), HasSubstr("expected a frame from 1 to 90, found '2000'"));
  EXPECT_THAT(refusal("c.bvh,0,20\n"), HasSubstr("expected a clip of the database, found 'c.bvh'"));
  EXPECT_EQ(read_file(here_.file("moves.db")), before);
  write_file(here_.file("cuts.csv"), "clip,begin_frame,end_frame\n\"a,b.bvh\",,\n", Overwrite::kAllow);
  import_cuts(database_, here_.file("cuts.csv"), OnLabels::kDiscard);
  EXPECT_TRUE(database_.fragments().empty());
}

}  // namespace
}  // namespace strut::test
