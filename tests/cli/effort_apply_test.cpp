// SPDX-License-Identifier: MIT
// strut effort learn and strut effort apply: from a database of labelled gestures to a clip with another Effort.
#include "support/program.h"
#include "support/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/effort/descriptors.h>
#include <strut/effort/fragment_database.h>
#include <strut/generate/gestures.h>
#include <strut/io/bvh.h>

namespace strut::test {
namespace {

using effort::EffortVector;
using testing::HasSubstr;

constexpr int kGestures = 8;

Motion gesture(generate::GestureAction action, const EffortVector& effort, std::uint64_t seed) {
  const generate::GestureStyle style{.suddenness = effort[effort::kTime],
                                     .boundness = effort[effort::kFlow],
                                     .strength = effort[effort::kWeight],
                                     .seed = seed};
  return generate::generate_gesture(generate::gesture_content(action), style, {}, 30.0).motion;
}

EffortVector effort_of(int i) {
  return {0.8 - 0.3 * (i % 4), 0.5 - 0.25 * (i % 5), -0.9 + 1.8 * i / (kGestures - 1)};
}

class EffortApplyCommand : public testing::Test {
 protected:
  EffortApplyCommand() {
    write_clip(here_.file("lift.bvh"), gesture(generate::GestureAction::kLift, EffortVector::Zero(), 99));
    write_clip(here_.file("bow.bvh"), gesture(generate::GestureAction::kBow, EffortVector::Zero(), 99));
  }
  /// Lifts, one group, all pairs accepted.
  effort::FragmentDatabase make_database() {
    const Motion first = gesture(generate::GestureAction::kLift, effort_of(0), 1);
    auto database = effort::FragmentDatabase::create(here_.file("moves.db"), first.shared_skeleton(), 30.0);
    for (int i = 0; i < kGestures; ++i) {
      const Motion motion = gesture(generate::GestureAction::kLift, effort_of(i), static_cast<std::uint64_t>(i) + 1);
      database.add_clip({"lift " + std::to_string(i), "", "lift"}, motion, {{0, motion.num_frames()}});
    }
    return database;
  }
  static void match(effort::FragmentDatabase& database) {
    constexpr double kCost = 0.3;  // m: as far as these lifts are from each other, not from a bow
    std::vector<effort::FragmentDatabase::GroupOf> groups;
    std::vector<effort::PairRecord> pairs;
    const auto fragments = database.fragments();
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      groups.push_back({fragments[i].id, 0});
      for (std::size_t j = 0; j < i; ++j) {
        pairs.push_back({fragments[j].id, fragments[i].id, kCost, 0.0, effort::PairStatus::kAccepted});
      }
    }
    database.set_matching(groups, pairs);
  }
  static void label(effort::FragmentDatabase& database) {
    std::vector<effort::LabelRecord> labels;
    int i = 0;
    for (const effort::FragmentRecord& fragment : database.fragments()) {
      effort::LabelRecord label;
      label.target = {effort::TargetKind::kFragment, fragment.id};
      label.rater = "ana";
      label.labelled_at = "2026-03-01T14:05:00Z";
      label.rating.head<3>() = effort_of(i++);
      labels.push_back(label);
    }
    database.add_labels(labels);
  }
  ProgramResult effort(std::vector<std::string> words) {
    words.insert(words.begin(), "effort");
    return here_.run(STRUT_PROGRAM, words);
  }
  void make_model() {
    auto database = make_database();
    match(database);
    label(database);
    const ProgramResult learnt = effort({"learn", "@moves.db", "-o", "@m.struteffort"});
    ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
    EXPECT_THAT(learnt.out, HasSubstr("8 labels of ana: 8 fragments in 1 groups, 28 pairs"));
    EXPECT_THAT(learnt.err, HasSubstr("only 8 fragments and 0 blends are labelled"));
  }
  double log_acceleration(const std::string& file) {
    return effort::describe(read_bvh(here_.file(file)).motion)[effort::kLogAcceleration];
  }

  Workplace here_;
};

TEST_F(EffortApplyCommand, MakesTheSameGestureMoreSudden) {
  make_model();
  for (const auto& [time, out] : {std::pair{"-0.8", "@slow.bvh"}, std::pair{"0.8", "@fast.bvh"}}) {
    const ProgramResult made = effort({"apply", "@m.struteffort", "@lift.bvh", "--time", time, "-o", out});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("1 snippets replaced, 100 % of the motion"));
  }
  EXPECT_LT(log_acceleration("slow.bvh"), log_acceleration("lift.bvh"));
  EXPECT_GT(log_acceleration("fast.bvh"), log_acceleration("lift.bvh"));
  const ProgramResult again = effort({"apply", "@m.struteffort", "@lift.bvh", "--time", "0.8", "-o", "@again.bvh"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_file(here_.file("again.bvh")), read_file(here_.file("fast.bvh")));
  EXPECT_THAT(here_.run(STRUT_PROGRAM, {"info", "@m.struteffort"}).out, HasSubstr("learnt from people's labels"));
  EXPECT_THAT(here_.run(STRUT_PROGRAM, {"info", "--json", "@m.struteffort"}).out, HasSubstr("\"effort model\""));
}

TEST_F(EffortApplyCommand, FollowsKeysAndReports) {
  make_model();
  write_file(here_.file("keys.csv"), "time_s,time,flow\n0,0.5,0\n2,0.7,-0.5\n");
  const ProgramResult made = effort({"apply", "@m.struteffort", "@lift.bvh", "--keys", "@keys.csv", "--weights",
                                     "noticed", "--report", "@r.csv", "-o", "@out.bvh"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(read_file(here_.file("r.csv")), HasSubstr("wanted_time"));
  const ProgramResult json =
      effort({"apply", "@m.struteffort", "@lift.bvh", "--flow", "0.3", "--report", "@r.json", "-o", "@out2.bvh"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  EXPECT_THAT(read_file(here_.file("r.json")), HasSubstr("\"coverage\""));
}

TEST_F(EffortApplyCommand, SaysWhatIsWrongWithSliders) {
  make_model();
  const auto apply = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"apply", "@m.struteffort", "@lift.bvh", "-o", "@out.bvh"});
    return effort(words);
  };
  EXPECT_EQ(apply({}).exit_code, 2);
  EXPECT_EQ(apply({"--time", "1.2"}).exit_code, 2);
  EXPECT_EQ(apply({"--flow", "nan"}).exit_code, 2);
  EXPECT_EQ(apply({"--time", "0.5", "--weights", "1,2"}).exit_code, 2);
  EXPECT_EQ(apply({"--time", "0.5", "--weights", "0,0,0"}).exit_code, 2);
  const std::pair<const char*, const char*> cases[] = {
      {"time_s,time\n1,0.5\n1,0.5\n", "keys.csv:3:1: error: expected a time after 1 s, found 1"},
      {"time_s,time\n1,1.5\n", "expected a number from -1 to 1, found 1.5"},
      {"time_s,space\n1,0.5\n", "'space'"},
      {"time_s\n1\n", "expected a column flow, weight or time"}};
  for (const auto& [text, message] : cases) {
    write_file(here_.file("keys.csv"), text, Overwrite::kAllow);
    const ProgramResult result = apply({"--keys", "@keys.csv"});
    EXPECT_EQ(result.exit_code, 3) << text;
    EXPECT_THAT(result.err, HasSubstr(message));
  }
  EXPECT_EQ(here_.entries().count("out.bvh"), 0U);
}

TEST_F(EffortApplyCommand, RefusesClipsItCannotChange) {
  make_model();
  const auto apply = [&](const std::string& clip) {
    return effort({"apply", "@m.struteffort", clip, "--time", "0.5", "-o", "@out.bvh"});
  };
  const ProgramResult bow = apply("@bow.bvh");
  EXPECT_EQ(bow.exit_code, 3);
  EXPECT_THAT(bow.err, HasSubstr("nothing in it is like any fragment of"));
  write_clip(here_.file("other.bvh"), renamed(gesture(generate::GestureAction::kLift, effort_of(1), 3), 3, "Beak"));
  EXPECT_EQ(apply("@other.bvh").exit_code, 4);
  const ProgramResult no_model = effort({"apply", "@lift.bvh", "@lift.bvh", "--time", "0.5", "-o", "@out.bvh"});
  EXPECT_EQ(no_model.exit_code, 3);
  EXPECT_THAT(no_model.err, HasSubstr("an effort model made by strut effort learn"));
  EXPECT_EQ(here_.entries().count("out.bvh"), 0U);
}

TEST_F(EffortApplyCommand, SaysWhatIsMissingToLearnFrom) {
  const auto learn = [&](std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"learn", "@moves.db", "-o", "@m.struteffort"});
    return effort(words);
  };
  auto database = make_database();
  const ProgramResult bare = learn();
  EXPECT_EQ(bare.exit_code, 3);
  EXPECT_THAT(bare.err, HasSubstr("moves.db: error: expected labels to learn from, got none"));
  EXPECT_THAT(bare.err, HasSubstr("strut effort labels"));
  EXPECT_THAT(bare.err, HasSubstr("strut effort estimate"));
  EXPECT_THAT(learn({"--estimates"}).err, HasSubstr("expected estimates to learn from"));
  label(database);
  EXPECT_THAT(learn().err, HasSubstr("strut effort match"));
  match(database);
  EXPECT_THAT(learn({"--rater", "bob"}).err, HasSubstr("ana"));
  EXPECT_EQ(learn({"--method", "magic"}).exit_code, 2);
  EXPECT_EQ(here_.entries().count("m.struteffort"), 0U);
  EXPECT_EQ(learn({"--rater", "ana", "--method", "svr"}).exit_code, 0);
  EXPECT_EQ(learn().exit_code, 1) << "it is there already";
}

}  // namespace
}  // namespace strut::test
