// SPDX-License-Identifier: MIT
// The script behind ./dev quality: its table on a program that only pretends, its page on generated walks.
#include "support/data.h"
#include "support/program.h"
#include "support/walks.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::Not;

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
  }
  ProgramResult quality(const std::string& program, const std::vector<std::string>& arguments) {
    const std::string script = std::string(STRUT_TEST_SOURCE_DIR) + "/bench/quality/quality.py";
    std::vector<std::string> all{script, folder_.path(), "--strut", program, "--vary-clip", STRUT_VARY_CLIP};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_program("/usr/bin/python3", all);
  }
  TemporaryFolder folder_;
};

class QualityTable : public Quality {
 protected:
  void SetUp() override {
    Quality::SetUp();
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
    return quality(folder_.file("pretender"), arguments);
  }
};

TEST_F(QualityTable, ComputesTheGap) {
  const ProgramResult result = table({"--cell", "walk/elderly"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| walk elderly | 5.00 | 1.00 | 2.00 | 0.75 | 1.00 | 1.00 | 0.50 | 0.50 | 1.00 |"));
  EXPECT_THAT(result.out, HasSubstr("1 of 1 cells translated; gap: median 0.75, lowest 0.75"));
}

TEST_F(QualityTable, KeepsGoingWhereACellIsRefusedAndSaysWhy) {
  const ProgramResult result = table({"--cell", "run/elderly", "--cell", "walk/elderly", "--cell", "walk/active"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("| run elderly | learn ended with exit code 1: strut: error: too few pairs |"));
  EXPECT_THAT(result.out, HasSubstr("| walk elderly | 5.00 |"));
  EXPECT_THAT(result.out, HasSubstr("| walk active | there is no file like "));
  EXPECT_THAT(result.out, HasSubstr("1 of 3 cells translated"));
}

TEST_F(QualityTable, ShowsTheTakesThatSettingsAreChosenOnInAShortTable) {
  const ProgramResult result = table({"--cell", "walk/elderly", "--split", "validation"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| walk elderly | 0.75 | 1.00 | 1.00 | 0.50 | 1.00 |"));
  EXPECT_THAT(result.out, HasSubstr("| **lowest** | 0.75 |"));
}

TEST_F(QualityTable, StandsBesideAnIndependentJudge) {
  write_file(folder_.file("judge"), "#!/bin/sh\necho '{\"identity\": 5.01, \"gap\": 0.7, \"cadence\": null}'\n");
  std::filesystem::permissions(folder_.file("judge"), std::filesystem::perms::owner_all);
  const ProgramResult result = table({"--cell", "walk/elderly", "--judge", folder_.file("judge")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| identity | 0.1996 % | walk elderly | yes |"));
  EXPECT_THAT(result.out, HasSubstr("| gap | 7.1429 % | walk elderly | no |"));
  EXPECT_THAT(result.out, Not(HasSubstr("\n| cadence |")));
}

TEST_F(QualityTable, RefusesAWrongCell) {
  EXPECT_EQ(table({"--cell", "walk"}).exit_code, 2);
}

/// A take to learn from in either half, and one to judge, of a walk and of two limps.
class QualityPage : public Quality {
 protected:
  void SetUp() override {
    Quality::SetUp();
    const std::map<std::string, double> limps{{"normal", 0.0}, {"elderly", 1.0}, {"active", 0.5}};
    for (const auto& [style, limp] : limps) {
      double seconds = 2.5;
      for (const char* take : {"001", "007", "013"}) {
        std::string name = "dataset-2_walk_";
        name.append(style).append("_").append(take).append(".bvh");
        write_clip(folder_.file(name), short_walk(limp, seconds += 0.5));
      }
    }
  }
};

TEST_F(QualityPage, HasEverySectionFilledFromARun) {
  const ProgramResult result =
      quality(STRUT_PROGRAM, {"--cell", "walk/elderly", "--cell", "walk/active", "--cell", "walk/feminine", "--joint",
                              "RightArm", "--page", folder_.file("page.md")});
  EXPECT_EQ(result.exit_code, 1) << "a cell has no clips; " << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 of 3 cells translated"));
  const std::string page = read_file(folder_.file("page.md"));
  for (const char* mishap : {"{{", "Refused:", "exit code"}) EXPECT_THAT(page, Not(HasSubstr(mishap)));
  for (const char* line : {"| walk elderly | ", "| walk feminine | there is no file like dataset-2_walk_feminine_",
                           "| gap at least 1.0 | ", "| paper | 2 | ", "| one pair | 2 | ", "| together | 2 | ",
                           "| walk feminine | refused | refused | ", "| translated clips | 2 of 2 (100 %)",
                           "| RightArm | exaggerated 1.75 times | 2 | ", "| a duck by a quarter of the leg | 2 of 2 | ",
                           "| a clip of another style | 2 of 2 | ", "| walk | "}) {
    EXPECT_THAT(page, HasSubstr(line));
  }
}

}  // namespace
}  // namespace strut::test
