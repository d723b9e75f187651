// SPDX-License-Identifier: MIT
// strut translate at the command line, with a model that copies what it is given: what comes out for clips of all
// sorts, and how models and clips that cannot be used are refused.
#include "support/program.h"
#include "support/small_model.h"
#include "support/walks.h"

#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/metrics/foot_slide.h>
#include <strut/model/style_model_io.h>
#include <strut/motion/body_parts.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>

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
    write_style_model(here_.file("style.strut"), StyleModel(exaggerating_parts(walk_, 0.3, 1.5)));
  }
  /// What comes out with the exaggerating model, in the input's time.
  Motion styled(std::vector<std::string> options) {
    options.insert(options.end(), {"--no-retime", "--no-generalization", "--no-clean-feet", "--force"});
    const ProgramResult result = translate(options, "@walk.bvh", "@style.strut");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_bvh(here_.file("out.bvh")).motion;
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
  EXPECT_THAT(here_.entries(), ElementsAre("copy.strut", "out.bvh", "style.strut", "walk.bvh"));
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

// Half a unit of the last printed place, of three angles and of every joint down to the hands.
constexpr double kPrinted = 1e-6;

TEST_F(TranslateCommand, GivesTheInputWhereNothingOfTheStyleIsAskedFor) {
  const Motion input = read_bvh(here_.file("walk.bvh")).motion;
  EXPECT_GT(largest_difference(styled({}), input), 0.1);
  std::vector<std::string> parts;
  for (const char* name : motion::kBodyPartNames) parts.insert(parts.end(), {"--part", std::string(name) + "=0"});
  for (const auto& options : std::vector<std::vector<std::string>>{
           {"--strength", "0"}, {"--pose", "0", "--movement", "0"}, parts, {"--blend", "@copy.strut=1"}}) {
    EXPECT_LT(largest_difference(styled(options), input), kPrinted) << options[0];
  }
}

TEST_F(TranslateCommand, HoldsFeetUnlessToldNotTo) {
  const auto slide = [this](const std::vector<std::string>& options) {
    const ProgramResult result = translate(options, "@walk.bvh", "@style.strut");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Motion motion = read_bvh(here_.file("out.bvh")).motion;
    const auto plants = postprocess::detect_footplants(motion, motion::find_legs(motion).value());
    return metrics::foot_slide(metrics::body_track(motion, motion.frame_rate()), plants).speed;
  };
  const double uncleaned = slide({"--force", "--no-clean-feet"});
  EXPECT_GT(uncleaned, 0.02);                      // [m/s]
  EXPECT_LT(slide({"--force"}), 0.2 * uncleaned);  // bones cannot stretch in a file without their positions
}

TEST_F(TranslateCommand, PutsPoseMovementPartsAndBlendsOnApart) {
  const Motion whole = styled({});
  for (const auto& options : std::vector<std::vector<std::string>>{
           {"--pose", "0"}, {"--movement", "0"}, {"--part", "left_arm=0"}, {"--blend", "@copy.strut=0.5"}}) {
    const Motion some = styled(options);
    EXPECT_GT(largest_difference(some, whole), 0.01) << options[0];
    EXPECT_GT(largest_difference(some, walk_), 0.01) << options[0];
  }
  EXPECT_LT(largest_difference(styled({"--blend", "@copy.strut=0.25", "--blend", "@copy.strut=0.25"}),
                               styled({"--blend", "@copy.strut=0.5"})),
            kPrinted);
}

TEST_F(TranslateCommand, RefusesPartsAndBlendsItCannotUnderstand) {
  const std::string parts = "trunk, head, left_arm, right_arm, left_leg, right_leg";
  for (const auto& [option, word, message] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"--part", "arm=1", "--part: expected NAME=X, NAME one of " + parts + ", got 'arm=1'"},
           {"--part", "head", "--part: expected head= and a number from 0 to 1.5, got 'head'"},
           {"--part", "head=2", "--part: expected head= and a number from 0 to 1.5, got 'head=2'"},
           {"--part", "head=nan", "--part: expected head= and a number from 0 to 1.5, got 'head=nan'"},
           {"--blend", "copy.strut", "--blend: expected MODEL.strut=SHARE, SHARE from 0 to 1, got 'copy.strut'"},
           {"--blend", "=0.5", "--blend: expected MODEL.strut=SHARE, SHARE from 0 to 1, got '=0.5'"},
           {"--blend", "a=1.2", "--blend: expected MODEL.strut=SHARE, SHARE from 0 to 1, got 'a=1.2'"},
           {"--confidence", "0", "--confidence: expected a number from 0.1 to 1000, got '0'"}}) {
    const ProgramResult result = translate({option, word});
    EXPECT_EQ(result.exit_code, 2) << word;
    EXPECT_EQ(result.err, "strut translate: error: " + message + "\nhint: strut translate --help tells more\n");
  }
  const ProgramResult too_much = translate({"--blend", "a=0.6", "--blend", "b=0.6"});
  EXPECT_THAT(too_much.err, HasSubstr("--blend: expected shares of at most 1 together, got 1.2"));
  EXPECT_TRUE(made_nothing());
}

TEST_F(TranslateCommand, RefusesToBlendModelsThatDoNotFit) {
  write_style_model(here_.file("tail.strut"), *copying_model(renamed(walk_, 4, "Tail")));
  const ProgramResult tail = translate({"--blend", "@tail.strut=0.5"});
  EXPECT_EQ(tail.exit_code, 4);
  EXPECT_THAT(tail.err, HasSubstr("tail.strut: error: not the skeleton of " + here_.file("copy.strut")));
  write_style_model(here_.file("fast.strut"), *copying_model(motion::resample(walk_, 60.0)));
  const ProgramResult fast = translate({"--blend", "@fast.strut=0.5"});
  EXPECT_EQ(fast.exit_code, 3);
  EXPECT_THAT(fast.err, HasSubstr("fast.strut: error: runs at 60 frames per second, " + here_.file("copy.strut") +
                                  " at 30\nhint: "));
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
