// SPDX-License-Identifier: MIT
// strut footplants at the command line: the same footplants as text, CSV and JSON, and which joints may be feet.
#include "support/program.h"
#include "support/walks.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

class FootplantsCommand : public testing::Test {
 protected:
  FootplantsCommand() {
    write_clip(here_.file("walk.bvh"), short_walk(0.0));
    write_clip(here_.file("limp.bvh"), short_walk(0.5));
  }
  ProgramResult footplants(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "footplants");
    return here_.run(STRUT_PROGRAM, arguments);
  }
  /// What the library finds in the file.
  std::vector<motion::Footplant> found(const std::string& name) {
    const Motion clip = read_bvh(here_.file(name)).motion;
    return postprocess::detect_footplants(clip, *motion::find_legs(clip));
  }

  Workplace here_;
};

TEST_F(FootplantsCommand, ListsWhatTheDetectorFindsAsJson) {
  const ProgramResult result = footplants({"@walk.bvh", "@limp.bvh", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json list = Json::parse(result.out);
  ASSERT_EQ(list.size(), 2U);
  const auto expected = found("limp.bvh");
  ASSERT_EQ(list[1].at("footplants").size(), expected.size());
  ASSERT_GE(expected.size(), 4U);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Json& plant = list[1].at("footplants")[i];
    EXPECT_EQ(plant.at("foot"), expected[i].foot == 0 ? "left" : "right");
    EXPECT_EQ(plant.at("begin"), expected[i].begin);
    EXPECT_EQ(plant.at("end"), expected[i].end);
    EXPECT_DOUBLE_EQ(plant.at("end_s"), expected[i].end / 30.0);
  }
}

TEST_F(FootplantsCommand, WritesTheTableThatLearningReads) {
  ASSERT_EQ(footplants({"@walk.bvh", "@limp.bvh", "-o", "@feet.csv"}).exit_code, 0);
  const std::string table = read_file(here_.file("feet.csv"));
  EXPECT_THAT(table, StartsWith("clip,foot,begin,end,begin_s,end_s\n"));
  EXPECT_EQ(table, footplants({"@walk.bvh", "@limp.bvh", "--csv"}).out);
  write_file(here_.file("pairs.toml"), "[[pair]]\ninput = \"walk.bvh\"\noutput = \"limp.bvh\"\n");
  const ProgramResult detected = here_.run(STRUT_PROGRAM, {"learn", "@pairs.toml", "-o", "@a.strut"});
  const ProgramResult given =
      here_.run(STRUT_PROGRAM, {"learn", "@pairs.toml", "-o", "@b.strut", "--footplants", "@feet.csv"});
  ASSERT_EQ(given.exit_code, 0) << given.err;
  EXPECT_EQ(given.out, detected.out);
  EXPECT_THAT(given.out, HasSubstr("footplants are told as labelled in "));
}

TEST_F(FootplantsCommand, TellsAPerson) {
  const ProgramResult result = footplants({"@walk.bvh"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("at 30 frames/s, " + std::to_string(found("walk.bvh").size()) + " footplants\n"));
  EXPECT_THAT(result.out, HasSubstr("\n  left "));
  EXPECT_THAT(result.out, HasSubstr("\n  right "));
}

TEST_F(FootplantsCommand, TakesTheFeetItIsTold) {
  const ProgramResult result = footplants({"@walk.bvh", "--feet", "RightToe,LeftFoot", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json swapped = Json::parse(result.out)[0].at("footplants");
  const auto expected = found("walk.bvh");
  ASSERT_EQ(swapped.size(), expected.size());
  int rights = 0;
  for (const auto& plant : expected) rights += plant.foot;
  for (std::size_t i = 0; i < swapped.size(); ++i) {
    EXPECT_EQ(swapped[i].at("foot"), static_cast<int>(i) < rights ? "left" : "right");
  }
}

TEST_F(FootplantsCommand, RefusesJointsThatAreNoFeet) {
  ProgramResult result = footplants({"@walk.bvh", "--feet", "LeftFoot,Tail"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("walk.bvh: error: --feet: expected names of the skeleton's joints, got 'Tail'"));
  EXPECT_THAT(result.err, HasSubstr("hint: its joints are: Hips, "));
  result = footplants({"@walk.bvh", "--feet", "LeftFoot,Head"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("ankles or toes with a leg (hip, knee and ankle) above them, got 'Head'"));
  result = footplants({"@walk.bvh", "--feet", "LeftFoot"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("strut footplants: error: --feet: expected two joints' names, LEFT,RIGHT"));
}

TEST_F(FootplantsCommand, RefusesWhatItCannotDo) {
  EXPECT_EQ(footplants({}).exit_code, 2);
  EXPECT_EQ(footplants({"@walk.bvh", "--csv", "--json"}).exit_code, 2);
  EXPECT_EQ(footplants({"@walk.bvh", "--height", "-1"}).exit_code, 2);
  EXPECT_EQ(footplants({"@missing.bvh"}).exit_code, 3);
  EXPECT_EQ(footplants({"@walk.bvh", "-o", "@walk.bvh", "--force"}).exit_code, 1);
  ASSERT_EQ(footplants({"@walk.bvh", "-o", "@feet.csv"}).exit_code, 0);
  EXPECT_EQ(footplants({"@walk.bvh", "-o", "@feet.csv"}).exit_code, 1);
  EXPECT_EQ(footplants({"@walk.bvh", "-o", "@feet.csv", "--force"}).exit_code, 0);
}

}  // namespace
}  // namespace strut::test
