// SPDX-License-Identifier: MIT
// strut translate at the command line, with a model that copies what it is given: what comes out for clips of all
// sorts, and how models and clips that cannot be used are refused.
#include "support/program.h"
#include "support/small_model.h"
#include "support/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model_io.h>

namespace strut::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class TranslateCommand : public testing::Test {
 protected:
  TranslateCommand() {
    write_clip(here_.file("walk.bvh"), walk_);
    write_style_model(here_.file("copy.strut"), *copying_model(walk_));
  }
  ProgramResult translate(std::vector<std::string> options, const std::string& clip = "@walk.bvh",
                          const std::string& model = "@copy.strut", const std::string& output = "@out.bvh") {
    options.insert(options.begin(), {"translate", model, clip, "-o", output});
    return here_.run(STRUT_PROGRAM, options);
  }
  [[nodiscard]] bool made_nothing() const { return here_.entries().count("out.bvh") == 0; }

  Workplace here_;
  Motion walk_ = short_walk(0.0, 2.0);
};

TEST_F(TranslateCommand, WritesAClipAndTellsItsLength) {
  const ProgramResult result = translate({});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("out.bvh: "));
  EXPECT_EQ(read_bvh(here_.file("out.bvh")).motion.frame_rate(), walk_.frame_rate());
  EXPECT_THAT(here_.entries(), ElementsAre("copy.strut", "out.bvh", "walk.bvh"));
}

TEST_F(TranslateCommand, TakesOtherUnitsAxesAndFrameRates) {
  for (const std::vector<std::string>& change : std::vector<std::vector<std::string>>{
           {"--unit", "m"}, {"--unit", "in"}, {"--up", "z"}, {"--frame-rate", "24"}, {"--frame-rate", "120"}}) {
    std::vector<std::string> command{"convert", "@walk.bvh", "-o", "@other.bvh", "--force"};
    command.insert(command.end(), change.begin(), change.end());
    ASSERT_EQ(here_.run(STRUT_PROGRAM, command).exit_code, 0);
    const ProgramResult result = translate({"--force"}, "@other.bvh");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const BvhClip other = read_bvh(here_.file("other.bvh")), translated = read_bvh(here_.file("out.bvh"));
    EXPECT_EQ(translated.layout.unit, other.layout.unit) << change[1];
    EXPECT_EQ(translated.layout.up, other.layout.up) << change[1];
    EXPECT_EQ(translated.motion.frame_rate(), other.motion.frame_rate()) << change[1];
  }
}

TEST_F(TranslateCommand, TakesOtherBoneLengths) {
  ASSERT_EQ(here_.run(STRUT_PROGRAM, {"convert", "@walk.bvh", "-o", "@tall.bvh", "--scale", "1.1"}).exit_code, 0);
  EXPECT_EQ(translate({}, "@tall.bvh").exit_code, 0);
}

TEST_F(TranslateCommand, RefusesAnotherSkeletonAndNamesItsJoints) {
  write_clip(here_.file("other.bvh"), renamed(walk_, 4, "Tail"));
  const ProgramResult result = translate({}, "@other.bvh");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, AllOf(HasSubstr("other.bvh: error: the skeleton does not fit: missing '" +
                                          walk_.skeleton().joint(4).name + "'; unknown 'Tail'"),
                                HasSubstr("hint: ")));
  EXPECT_TRUE(made_nothing());
}

TEST_F(TranslateCommand, RefusesAClipOfOneFrame) {
  write_clip(here_.file("pose.bvh"), walk_.slice(0, 1));
  const ProgramResult result = translate({}, "@pose.bvh");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err, here_.file("pose.bvh") + ": error: expected at least two frames, got 1\n");
  EXPECT_TRUE(made_nothing());
}

TEST_F(TranslateCommand, RefusesWhatIsNoModel) {
  const std::string bytes = read_file(here_.file("copy.strut"));
  write_file(here_.file("cut.strut"), bytes.substr(0, bytes.size() / 2));
  write_file(here_.file("stub.strut"), bytes.substr(0, 8));
  write_file(here_.file("empty.strut"), "");
  for (const auto& [model, reason] :
       {std::pair("@cut.strut", "expected an intact style model"),
        std::pair("@stub.strut", "expected an intact style model"), std::pair("@empty.strut", "found an empty file"),
        std::pair("@walk.bvh", "expected a style model made by strut learn"),
        std::pair("@missing.strut", "cannot open")}) {
    const ProgramResult result = translate({}, "@walk.bvh", model);
    EXPECT_EQ(result.exit_code, 3) << model;
    EXPECT_THAT(result.err, HasSubstr(here_.file(std::string(model).substr(1)) + ": error: "));
    EXPECT_THAT(result.err, HasSubstr(reason));
  }
  EXPECT_TRUE(made_nothing());
}

TEST_F(TranslateCommand, RefusesOptionsOutOfRange) {
  for (const char* strength : {"-1", "1.6", "nan", "much"}) {
    const ProgramResult result = translate({"--strength", strength});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, "strut translate: error: --strength: expected a number from 0 to 1.5, got '" +
                              std::string(strength) + "'\nhint: strut translate --help tells more\n");
  }
  EXPECT_EQ(translate({"--warm-up", "inf"}).exit_code, 2);
  EXPECT_TRUE(made_nothing());
}

TEST_F(TranslateCommand, DoesNotOverwriteUnaskedNorItsOwnModelIfForced) {
  ASSERT_EQ(translate({}).exit_code, 0);
  const ProgramResult again = translate({});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(again.err, here_.file("out.bvh") + ": error: the file already exists\nhint: use --force to overwrite it\n");
  EXPECT_EQ(translate({"--force"}).exit_code, 0);
  EXPECT_EQ(translate({"--force"}, "@walk.bvh", "@copy.strut", "@copy.strut").exit_code, 1);
  EXPECT_NO_THROW(read_style_model(here_.file("copy.strut")));
}

}  // namespace
}  // namespace strut::test
