// SPDX-License-Identifier: MIT
// strut learn at the command line: a model from a pair list, and how lists and clips that give none are refused.
#include "support/program.h"
#include "support/walks.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/model/style_model_io.h>

namespace strut::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class LearnCommand : public testing::Test {
 protected:
  LearnCommand() {
    write_clip(here_.file("normal.bvh"), normal_);
    write_clip(here_.file("limp.bvh"), limp_);
  }
  ProgramResult learn(const std::string& list, const std::vector<std::string>& options = {}) {
    write_file(here_.file("pairs.toml"), list, Overwrite::kAllow);
    std::vector<std::string> arguments{"learn", "@pairs.toml", "-o", "@limp.strut", "--force"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return here_.run(STRUT_PROGRAM, arguments);
  }
  [[nodiscard]] bool made_nothing() const {
    const auto found = here_.entries();
    return std::none_of(found.begin(), found.end(),
                        [](const std::string& name) { return name.find(".strut") != std::string::npos; });
  }
  /// A pair of these clips with further lines.
  static std::string of(const std::string& input, const std::string& output, const std::string& more = "") {
    return "[[pair]]\ninput = \"" + input + "\"\noutput = \"" + output + "\"\n" + more;
  }

  Workplace here_;
  Motion normal_ = short_walk(0.0), limp_ = short_walk(0.5);
};

TEST_F(LearnCommand, LearnsFromASinglePairAndWarns) {
  const ProgramResult result = learn(of("normal.bvh", "limp.bvh"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("learnt from 1 pair"));
  EXPECT_THAT(result.err, HasSubstr("warning:"));
  EXPECT_EQ(read_style_model(here_.file("limp.strut"))->frame_rate(), 30.0);
}

TEST_F(LearnCommand, MakesTheKindOfModelItIsTold) {
  struct Kind {
    std::vector<std::string> options;
    bool is_radial;
    int contexts;
  };
  for (const auto& [options, is_radial, contexts] :
       {Kind{{"--context", "4", "--centres", "9", "--width", "3", "--shrinkage", "0.2"}, true, 4},
        Kind{{"--method", "radial", "--context", "0", "--max-order", "2"}, false, 0},
        Kind{{"--method", "linear", "--context", "2", "--max-order", "2"}, false, 2},
        Kind{{"--method", "paper"}, false, 0}}) {
    const ProgramResult result = learn(of("normal.bvh", "limp.bvh"), options);
    ASSERT_EQ(result.exit_code, 0) << options[1] << result.err;
    const auto model = read_style_model(here_.file("limp.strut"));
    EXPECT_EQ(model->radial_map().has_value(), is_radial) << options[1];
    EXPECT_EQ(model->blocks().empty(), is_radial) << options[1];
    EXPECT_EQ(model->context().rows(), contexts) << options[1];
    EXPECT_EQ(is_radial ? model->radial_map()->basis.num_centres() : 9, 9) << options[1];
    EXPECT_THAT(model->provenance(), HasSubstr("\"method\":"));
  }
}

TEST_F(LearnCommand, RefusesPairsTooShortAndNamesThem) {
  const ProgramResult result = learn(of("normal.bvh", "limp.bvh", "input_frames = [0, 5]\noutput_frames = [0, 5]\n"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("normal.bvh [0, 5]"), HasSubstr("left out: it lasts less than 0.2 s"),
                                HasSubstr("pairs.toml: error: expected at least one pair that can be aligned")));
  EXPECT_TRUE(made_nothing());
}

TEST_F(LearnCommand, RefusesPairsOfLengthsTooFarApart) {
  const ProgramResult result = learn(of("normal.bvh", "limp.bvh", "input_frames = [0, 10]\n"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("warning: left out:"), HasSubstr("got none of 1")));
  EXPECT_TRUE(made_nothing());
}

TEST_F(LearnCommand, RefusesExamplesInWhichNothingMoves) {
  write_clip(here_.file("still.bvh"), held(normal_, 60));
  const ProgramResult result = learn(of("still.bvh", "still.bvh"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("pairs.toml: error: expected clips in which something moves"));
  EXPECT_TRUE(made_nothing());
}

TEST_F(LearnCommand, NamesTheClipOfAnotherSkeleton) {
  write_clip(here_.file("other.bvh"), renamed(limp_, 4, "Tail"));
  const ProgramResult result = learn(of("normal.bvh", "limp.bvh") + of("normal.bvh", "other.bvh"));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, AllOf(HasSubstr("other.bvh: error: not the skeleton of "), HasSubstr("unknown 'Tail'")));
  EXPECT_TRUE(made_nothing());
}

TEST_F(LearnCommand, SaysWhereTheListNamesAMissingClip) {
  const ProgramResult result = learn(of("normal.bvh", "missing.bvh"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("missing.bvh: error: cannot open"), HasSubstr("pairs.toml:3, relative to")));
  EXPECT_TRUE(made_nothing());
}

TEST_F(LearnCommand, RefusesListsWithFaultsInThem) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "pairs.toml: error: expected at least one '[[pair]]', found none"},
      {"[[pair\n", "pairs.toml:1:7: error: expected ']'"},
      {"[[pair]]\ninput = normal.bvh\n", "pairs.toml:2:10: error: expected a file name in quotes"},
      {of("normal.bvh", "limp.bvh", "outputs = 3\n"), "pairs.toml:4:1: error: expected 'input', 'output'"},
      {of("normal.bvh", "limp.bvh", "input_frames = [9, 3]\n"), "error: expected an end after frame 9, found 3"},
      {of("normal.bvh", "limp.bvh", "input_frames = [0, 9999]\n"), "error: expected frames within 0 and 90"},
      {std::string("\xff\xfe\0\1", 4), "pairs.toml:1:1: error: expected a pair list in TOML"},
      {read_file(here_.file("normal.bvh")), "pairs.toml:1:10: error: expected '='"}};
  for (const auto& [list, message] : faults) {
    const ProgramResult result = learn(list);
    EXPECT_EQ(result.exit_code, 3) << message;
    EXPECT_THAT(result.err, AllOf(HasSubstr(message), Not(HasSubstr("while parsing"))));
  }
  EXPECT_TRUE(made_nothing());
}

TEST_F(LearnCommand, TakesClipsOfDifferentFrameRates) {
  write_clip(here_.file("fast.bvh"), Motion(limp_.shared_skeleton(), 60.0, [&] {
               std::vector<Pose> twice;
               for (const Pose& pose : limp_.frames()) twice.insert(twice.end(), 2, pose);
               return twice;
             }()));
  const ProgramResult result = learn(of("normal.bvh", "fast.bvh"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_style_model(here_.file("limp.strut"))->frame_rate(), 30.0);
}

TEST_F(LearnCommand, TakesFootplantsFromATable) {
  write_file(here_.file("feet.csv"), "foot,clip,end,begin,who\nleft,limp.bvh,90,0,me\n\"left\",other.bvh,3,1,me\n");
  const ProgramResult result = learn(of("normal.bvh", "limp.bvh"), {"--footplants", "@feet.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("'other.bvh' is no output clip of the pair list"));
  const auto model = read_style_model(here_.file("limp.strut"));
  const Eigen::VectorXd state = Eigen::VectorXd::Ones(model->state_size());
  ASSERT_TRUE(model->footplants());
  EXPECT_TRUE(model->footplants()->is_planted(0, state));
  EXPECT_FALSE(model->footplants()->is_planted(1, state));
}

TEST_F(LearnCommand, RefusesFootplantsWithFileLineAndColumn) {
  const std::string head = "clip,foot,begin,end\n";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"limp.bvh,both,0,5\n", "feet.csv:2:10: error: expected left or right, found 'both'"},
      {"limp.bvh,left,0,5\nlimp.bvh,left,-1,5\n", "feet.csv:3:15: error: expected a frame from 0 to"},
      {"limp.bvh,left,5,5\n", "feet.csv:2:17: error: expected a frame from 6 to"},
      {"limp.bvh,left,1,500000\n", "feet.csv:2:17: error: expected a frame from 2 to"},
      {"limp.bvh,left,1.5,5\n", "feet.csv:2:15: error: expected a frame from 0 to"},
      {"limp.bvh,left,a,5\n", "feet.csv:2:15: error: expected a finite number, found 'a'"},
      {"limp.bvh,left,1\n", "feet.csv:2: error: expected 4 fields, found 3"},
      {"other.bvh,left,1,5\n", "feet.csv: error: expected footplants of the pair list's output clips, found none"}};
  for (const auto& [lines, message] : faults) {
    write_file(here_.file("feet.csv"), head + lines, Overwrite::kAllow);
    const ProgramResult result = learn(of("normal.bvh", "limp.bvh"), {"--footplants", "@feet.csv"});
    EXPECT_EQ(result.exit_code, 3) << message;
    EXPECT_THAT(result.err, HasSubstr(message));
  }
  EXPECT_TRUE(made_nothing());
}

TEST_F(LearnCommand, DoesNotOverwriteItsOwnClipsEvenIfForced) {
  write_file(here_.file("pairs.toml"), of("normal.bvh", "limp.bvh"));
  for (const char* own : {"@pairs.toml", "@normal.bvh", "@limp.bvh"}) {
    const ProgramResult result = here_.run(STRUT_PROGRAM, {"learn", "@pairs.toml", "-o", own, "--force"});
    EXPECT_EQ(result.exit_code, 1) << own;
    EXPECT_THAT(result.err, HasSubstr("error: is needed as"));
  }
}

}  // namespace
}  // namespace strut::test
