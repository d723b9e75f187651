// SPDX-License-Identifier: MIT
// The script that makes the quality table, run on a program that only pretends.
#include "support/data.h"
#include "support/program.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>

namespace strut::test {
namespace {

using testing::HasSubstr;

// Says what was given to it by names alone: untranslated clips are 5 cm away, retakes 1 cm, translated clips 2 cm.
constexpr const char* kPretender = R"(#!/bin/sh
case "$1 $2" in
  "measure "*translated_*) distance=2 ;;
  "measure "*normal_009*|"measure "*normal_01*) distance=5 ;;
  *) distance=1 ;;
esac
while [ $# -gt 1 ]; do
  [ "$1" = -o ] && cp /dev/null "$2"
  [ "$1" = learn ] && case "$2" in *run_*) echo "strut: error: too few pairs" >&2; exit 1 ;; esac
  shift
done
echo '{"distance_cm": '$distance', "clips": [{"travel_m": 3, "speed_m_per_s": 1, "cadence_per_s": 2,'
echo '"foot_slide_cm_per_s": 0.5, "jerk_m_per_s3": 60}]}'
)";

class Quality : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "needs /usr/bin/python3";
    write_file(folder_.file("pretender"), kPretender);
    std::filesystem::permissions(folder_.file("pretender"), std::filesystem::perms::owner_all);
    for (const char* content : {"walk", "run"}) {
      for (const char* style : {"normal", "elderly"}) {
        for (const char* take : {"001", "002", "009", "013", "014"}) {
          write_file(folder_.file(std::string("dataset-2_") + content + "_" + style + "_" + take + ".bvh"), "");
        }
      }
    }
  }
  ProgramResult table(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{STRUT_TEST_SOURCE_DIR "/bench/quality/quality.py", folder_.path(), "--strut",
                                 folder_.file("pretender")};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_program("/usr/bin/python3", all);
  }
  TemporaryFolder folder_;
};

TEST_F(Quality, ComputesTheGap) {
  const ProgramResult result = table({"--cell", "walk/elderly"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| walk elderly | 5.00 | 1.00 | 2.00 | 0.75 | 1.00 | 1.00 | 0.50 | 0.50 | 1.00 |"));
  EXPECT_THAT(result.out, HasSubstr("1 of 1 cells translated; gap: median 0.75, lowest 0.75"));
}

TEST_F(Quality, KeepsGoingWhereACellIsRefusedAndSaysWhy) {
  const ProgramResult result = table({"--cell", "run/elderly", "--cell", "walk/elderly", "--cell", "walk/active"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("| run elderly | learn ended with exit code 1: strut: error: too few pairs |"));
  EXPECT_THAT(result.out, HasSubstr("| walk elderly | 5.00 |"));
  EXPECT_THAT(result.out, HasSubstr("| walk active | there is no file like "));
  EXPECT_THAT(result.out, HasSubstr("1 of 3 cells translated"));
}

TEST_F(Quality, ShowsTheTakesThatSettingsAreChosenOnInAShortTable) {
  const ProgramResult result = table({"--cell", "walk/elderly", "--split", "validation"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| walk elderly | 0.75 | 1.00 | 1.00 | 0.50 | 1.00 |"));
  EXPECT_THAT(result.out, HasSubstr("| **lowest** | 0.75 |"));
}

TEST_F(Quality, RefusesAWrongCell) {
  EXPECT_EQ(table({"--cell", "walk"}).exit_code, 2);
}

}  // namespace
}  // namespace strut::test
