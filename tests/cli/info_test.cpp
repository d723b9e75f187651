// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/program.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::json;

ProgramResult info(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "info");
  return run_program(STRUT_PROGRAM, arguments);
}

const std::string kPerson = test_file("data/person.bvh");
const std::string kPersonZUp = test_file("data/person_z_up.bvh");
const std::string kBroken = test_file("malformed/nan_in_row.bvh");

TEST(Info, TellsAFilesFramesUnitsAndHierarchy) {
  const ProgramResult result = info({kPerson});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, kPerson +
                            "\n"
                            "  frames     3 at 30 frames/s: 0.10 s\n"
                            "  joints     7, pelvis 'Hips', 24 channels\n"
                            "  unit       centimetres (guessed)\n"
                            "  up axis    Y (guessed)\n"
                            "  height     1.66 m\n"
                            "  travel     0.06 m, 0.06 m from start to end\n"
                            "  hierarchy\n"
                            "    Hips           position XYZ, rotation ZXY\n"
                            "      Spine        rotation ZXY\n"
                            "        Head       rotation ZXY\n"
                            "      LeftLeg      rotation ZXY\n"
                            "        LeftFoot   rotation ZXY\n"
                            "      RightLeg     rotation ZXY\n"
                            "        RightFoot  rotation ZXY\n");
}

TEST(Info, GivesALineToEachOfManyFiles) {
  const ProgramResult result = info({kPerson, kPersonZUp});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, StartsWith(" frames frames/s  seconds joints  unit        up height m travel m  file\n"));
  EXPECT_THAT(result.out, HasSubstr("24     0.08      3  metres      Z      1.67     0.10  " + kPersonZUp));
}

TEST(Info, GivesJsonWithUnitsInTheNames) {
  const ProgramResult result = info({kPersonZUp, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json clip = Json::parse(result.out).at(0);
  EXPECT_EQ(clip.at("num_frames"), 2);
  EXPECT_EQ(clip.at("frame_rate"), 24.0);
  EXPECT_EQ(clip.at("unit"), "metres");
  EXPECT_EQ(clip.at("up"), "Z");
  EXPECT_EQ(clip.at("unit_guessed"), true);
  EXPECT_NEAR(clip.at("travel_m"), 0.1, 1e-9);
  EXPECT_EQ(clip.at("joints").at(2).at("name"), "Foot");
  EXPECT_EQ(clip.at("joints").at(2).at("parent"), 0);
}

TEST(Info, TakesTheUnitAndTheAxisThatAreGiven) {
  const ProgramResult result = info({kPerson, "--unit", "in", "--up", "z"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("unit       inches\n"));
  EXPECT_THAT(result.out, HasSubstr("up axis    Z\n"));
  EXPECT_THAT(result.err, HasSubstr("warning: the skeleton spans 4.21 m, which no person does"));
}

TEST(Info, TellsTheGoodFilesAndNamesEveryBadOne) {
  const ProgramResult result = info({kBroken, kPerson, "missing.bvh"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr(kPerson));
  EXPECT_THAT(result.err, HasSubstr("nan_in_row.bvh:20:3: error: expected a finite number, found 'nan'\n"));
  EXPECT_THAT(result.err, HasSubstr("missing.bvh: error: cannot open: No such file or directory\n"));
}

TEST(Info, RefusesAUnitThatIsNone) {
  const ProgramResult result = info({kPerson, "--unit", "parsec"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, StartsWith("strut info: error: --unit: expected m, cm, mm, in or ft, got 'parsec'\n"));
}

TEST(Info, WantsAFile) {
  EXPECT_EQ(info({}).exit_code, 2);
  EXPECT_EQ(info({test_file("data")}).exit_code, 3);
}

}  // namespace
}  // namespace strut::test
