// SPDX-License-Identifier: MIT
// The five commands of strut effort --help, run as they stand there on a folder of clips: by estimates, and by labels
// that were imported. And what the commands say of bad input: one line, and a database that stays as it was.
#include "support/program.h"
#include "support/walks.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>
#include <strut/effort/descriptors.h>
#include <strut/effort/fragment_database.h>
#include <strut/generate/gestures.h>
#include <strut/io/bvh.h>

namespace strut::test {
namespace {

using effort::FragmentDatabase;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kClips = 10;

Motion lift(double time, std::uint64_t seed) {
  const generate::GestureStyle style{.suddenness = time, .boundness = 0.4 * time, .strength = -0.3, .seed = seed};
  return generate::generate_gesture(generate::gesture_content(generate::GestureAction::kLift), style, {}, 30.0).motion;
}

/// Suddenness from -0.9 to 0.9.
double time_of(int i) {
  return -0.9 + 1.8 * i / (kClips - 1);
}

class EffortSteps : public testing::Test {
 protected:
  EffortSteps() {
    std::filesystem::create_directory(here_.file("clips"));
    for (int i = 0; i < kClips; ++i) {
      clips_.push_back("@clips/lift_00" + std::to_string(i) + ".bvh");
      write_clip(here_.file(clips_.back().substr(1)), lift(time_of(i), static_cast<std::uint64_t>(i) + 1));
    }
    write_clip(here_.file("clip.bvh"), lift(0.0, 99));
  }
  ProgramResult effort(std::vector<std::string> words) {
    words.insert(words.begin(), "effort");
    return here_.run(STRUT_PROGRAM, std::move(words));
  }
  ProgramResult done(std::vector<std::string> words) {
    const ProgramResult result = effort(words);
    EXPECT_EQ(result.exit_code, 0) << words.front() << ": " << result.err;
    return result;
  }
  void segment() {
    std::vector<std::string> words{"segment", "@moves.db"};
    words.insert(words.end(), clips_.begin(), clips_.end());
    EXPECT_THAT(done(words).out, HasSubstr("10 clips added"));
  }
  /// What a person would fill in: every fragment as sudden as its clip was made.
  void write_labels(const std::string& source) {
    std::string text = "fragment,rater,labelled_at,source,time\n";
    for (const auto& fragment : FragmentDatabase::open(here_.file("moves.db")).fragments()) {
      const auto clip = static_cast<int>(fragment.clip) - 1;
      text +=
          std::to_string(fragment.id) + ",ana,2026-03-01T12:00," + source + "," + std::to_string(time_of(clip)) + "\n";
    }
    write_file(here_.file("labels.csv"), text, Overwrite::kAllow);
  }
  double log_acceleration(const std::string& file) {
    return effort::describe(read_bvh(here_.file(file)).motion)[effort::kLogAcceleration];
  }
  void expect_sliders_to_show() {
    done({"apply", "@moves.struteffort", "@clip.bvh", "--time", "0.8", "-o", "@sudden.bvh"});
    done({"apply", "@moves.struteffort", "@clip.bvh", "--time", "-0.8", "-o", "@sustained.bvh"});
    EXPECT_GT(log_acceleration("sudden.bvh"), log_acceleration("sustained.bvh") + 0.3);
  }

  Workplace here_;
  std::vector<std::string> clips_;
};

TEST_F(EffortSteps, HelpNamesTheFive) {
  const ProgramResult help = effort({"--help"});
  for (const char* step : {"strut effort segment moves.db clips/*.bvh", "strut effort match moves.db",
                           "strut effort estimate moves.db", "strut effort learn moves.db --estimates -o moves.strut",
                           "strut effort apply moves.struteffort clip.bvh --time 0.8 -o sudden.bvh",
                           "strut effort labels moves.db --import labels.csv"}) {
    EXPECT_THAT(help.out, HasSubstr(step));
  }
}

TEST_F(EffortSteps, LeadFromAFolderOfClipsToASlider) {
  segment();
  done({"match", "@moves.db"});
  const ProgramResult estimated = done({"estimate", "@moves.db"});
  EXPECT_THAT(estimated.out, AllOf(HasSubstr("lift_000 frames "), Not(HasSubstr("clips/lift"))));
  EXPECT_THAT(estimated.out, HasSubstr("a rule of thumb"));
  EXPECT_THAT(estimated.out, HasSubstr("--estimates -o moves.struteffort"));
  const ProgramResult learnt = done({"learn", "@moves.db", "--estimates", "-o", "@moves.struteffort"});
  EXPECT_THAT(learnt.out, AllOf(HasSubstr("learnt from the program's estimates"), HasSubstr("lift_000 frames ")));
  expect_sliders_to_show();
}

TEST_F(EffortSteps, LeadThereByLabels) {
  segment();
  done({"match", "@moves.db"});
  write_labels("person");
  EXPECT_THAT(done({"labels", "@moves.db", "--import", "@labels.csv"}).out, HasSubstr("labels added"));
  EXPECT_THAT(done({"labels", "@moves.db"}).out, HasSubstr("person"));
  const ProgramResult learnt = done({"learn", "@moves.db", "-o", "@moves.struteffort"});
  EXPECT_THAT(learnt.out, HasSubstr("learnt from people's labels"));
  expect_sliders_to_show();
}

TEST_F(EffortSteps, TakeASyntheticRaterOnlyIfNamed) {
  segment();
  done({"match", "@moves.db"});
  write_labels("synthetic");
  done({"labels", "@moves.db", "--import", "@labels.csv"});
  const ProgramResult refused = effort({"learn", "@moves.db", "-o", "@moves.struteffort"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("synthetic raters' alone: ana"), HasSubstr("--rater")));
  EXPECT_THAT(done({"estimate", "@moves.db"}).out, Not(HasSubstr("off by")));
  EXPECT_THAT(done({"estimate", "@moves.db", "--rater", "ana"}).out, HasSubstr("as ana labels"));
  EXPECT_EQ(effort({"estimate", "@moves.db", "--rater", "bob"}).exit_code, 3);
  EXPECT_THAT(done({"learn", "@moves.db", "--rater", "ana", "-o", "@moves.struteffort"}).out,
              HasSubstr("learnt from a synthetic rater's labels"));
}

TEST_F(EffortSteps, TellProgramsTheSame) {
  segment();
  done({"match", "@moves.db"});
  write_labels("person");
  const auto taken = nlohmann::json::parse(done({"labels", "@moves.db", "--import", "@labels.csv", "--json"}).out);
  EXPECT_GE(taken.at("import").at("added").get<int>(), kClips);
  EXPECT_EQ(taken.at("raters").at(0).at("rater"), "ana");
  const auto estimated = nlohmann::json::parse(done({"estimate", "@moves.db", "--json"}).out);
  EXPECT_GE(estimated.at("fragments").size(), static_cast<std::size_t>(kClips));
  EXPECT_TRUE(estimated.at("fragments").at(0).at("time").contains("confidence"));
  const auto learnt = nlohmann::json::parse(done({"learn", "@moves.db", "-o", "@moves.struteffort", "--json"}).out);
  EXPECT_EQ(learnt.at("kind"), "effort model");
}

TEST_F(EffortSteps, KnowADatabaseWithoutReadingIt) {
  segment();
  std::error_code failure;
  constexpr std::uintmax_t kTooLong = std::uintmax_t{1} << 40;  // bytes; takes no room on the disk
  std::filesystem::resize_file(here_.file("moves.db"), kTooLong, failure);
  if (failure) GTEST_SKIP() << "no sparse files here";
  const ProgramResult info = here_.run(STRUT_PROGRAM, {"info", "@moves.db"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("fragment database"));
}

TEST_F(EffortSteps, RefuseBadInputInOneLineAndLeaveTheDatabase) {
  segment();
  done({"match", "@moves.db"});
  write_labels("person");
  done({"labels", "@moves.db", "--import", "@labels.csv"});
  done({"learn", "@moves.db", "--no-validation", "-o", "@moves.struteffort"});
  write_file(here_.file("out_of_range.csv"), "fragment,rater,labelled_at,time\n1,eve,2026-03-01T12:00,1.5\n");
  write_file(here_.file("unknown.csv"), "fragment,rater,labelled_at,time\n999,eve,2026-03-01T12:00,0.5\n");
  write_file(here_.file("no_cuts.csv"), "clip,begin_frame,end_frame\n" + here_.file("clips/lift_000.bvh") + ",,\n");
  write_file(here_.file("junk.bvh"), "no clip at all");
  std::string model = read_file(here_.file("moves.struteffort"));
  model.resize(model.size() / 2);
  write_file(here_.file("half.struteffort"), model);
  write_clip(here_.file("walk.bvh"), lift(0.0, 5).slice(0, 3));
  const std::string before = read_file(here_.file("moves.db"));
  struct Case {
    std::vector<std::string> words;
    const char* message;
  };
  for (const auto& [words, message] : std::vector<Case>{
           {{"labels", "@moves.db", "--import", "@out_of_range.csv"}, "out_of_range.csv:2:"},
           {{"labels", "@moves.db", "--import", "@unknown.csv"}, "expected a fragment of the database"},
           {{"segment", "@moves.db", "--import", "@no_cuts.csv"}, "--discard-labels"},
           {{"segment", "@moves.db", "@junk.bvh"}, "junk.bvh:1:"},
           {{"match", "@junk.bvh"}, "expected a fragment database"},
           {{"learn", "@junk.bvh", "-o", "@x.struteffort"}, "expected a fragment database"},
           {{"next", "@clip.bvh"}, "expected a fragment database"},
           {{"apply", "@half.struteffort", "@clip.bvh", "--time", "0.5", "-o", "@x.bvh"}, "half.struteffort: error: "},
           {{"apply", "@moves.struteffort", "@junk.bvh", "--time", "0.5", "-o", "@x.bvh"}, "junk.bvh:1:"},
           {{"apply", "@moves.struteffort", "@walk.bvh", "--time", "0.5", "-o", "@x.bvh"}, "walk.bvh: error: "}}) {
    const ProgramResult result = effort(words);
    EXPECT_EQ(result.exit_code, 3) << message << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 2) << "a line and a hint: " << result.err;
    EXPECT_EQ(read_file(here_.file("moves.db")), before) << message;
  }
  EXPECT_EQ(here_.entries().count("x.bvh") + here_.entries().count("x.struteffort"), 0U);
}

TEST_F(EffortSteps, SayWhatAnEmptyDatabaseLacks) {
  const Motion motion = lift(0.0, 1);
  FragmentDatabase::create(here_.file("moves.db"), motion.shared_skeleton(), 30.0);
  const std::string before = read_file(here_.file("moves.db"));
  EXPECT_THAT(done({"labels", "@moves.db"}).out, HasSubstr("no labels"));
  for (const auto& words : std::vector<std::vector<std::string>>{{"match", "@moves.db"},
                                                                 {"estimate", "@moves.db"},
                                                                 {"next", "@moves.db"},
                                                                 {"learn", "@moves.db", "-o", "@x.struteffort"}}) {
    const ProgramResult result = effort(words);
    EXPECT_EQ(result.exit_code, 3) << words.front();
    EXPECT_THAT(result.err, AllOf(HasSubstr("moves.db: error: "), HasSubstr("hint: "))) << words.front();
    EXPECT_EQ(read_file(here_.file("moves.db")), before) << words.front();
  }
}

TEST_F(EffortSteps, SayThatNothingCanBeBlendedInAGroupOfOne) {
  clips_.resize(1);
  std::vector<std::string> words{"segment", "@moves.db", clips_.front()};
  done(words);
  done({"match", "@moves.db"});
  done({"estimate", "@moves.db"});
  const ProgramResult learnt = effort({"learn", "@moves.db", "--estimates", "-o", "@moves.struteffort"});
  EXPECT_EQ(learnt.exit_code, 3);
  EXPECT_THAT(learnt.err, AllOf(HasSubstr("pairs of labelled fragments that can be blended"), HasSubstr("hint: ")));
}

}  // namespace
}  // namespace strut::test
