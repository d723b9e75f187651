// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/program.h"

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>

namespace strut::test {
namespace {

using testing::HasSubstr;

/// What stands after `name` in its line, as far as it is numbers.
std::vector<double> numbers_after(const std::string& text, const std::string& name) {
  std::istringstream rest(text.substr(text.find(name) + name.size()));
  std::vector<double> numbers;
  for (double number = 0.0; rest >> number;) numbers.push_back(number);
  return numbers;
}

TEST(Demo, LearnsALimpAndReportsIt) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(STRUT_PROGRAM, {"demo", "-o", folder.file("made")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* name : {"normal_1.bvh", "limp_9.bvh", "pairs.toml", "limp.strut", "input.bvh", "truth.bvh"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.file("made/") + name)) << name;
  }

  const std::string page = read_file(folder.file("made/demo.html"));
  for (const char* name : {"Input", "Output", "True answer"}) EXPECT_THAT(page, HasSubstr(name));
  EXPECT_THAT(read_file(folder.file("made/demo.svg")), HasSubstr("True answer"));
  const auto cm = numbers_after(result.out, "Distance to the true answer [cm]");
  ASSERT_EQ(cm.size(), 2U);
  EXPECT_LT(cm[1], 0.5 * cm[0]);  // measured: 0.9 against 4.1
}

TEST(Demo, RefusesToOverwriteBeforeItWritesAnything) {
  const TemporaryFolder folder;
  write_file(folder.file("demo.html"), "mine");
  const ProgramResult result = run_program(STRUT_PROGRAM, {"demo", "-o", folder.path()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("demo.html"));
  EXPECT_THAT(result.err, HasSubstr("--force"));
  EXPECT_EQ(read_file(folder.file("demo.html")), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder.file("normal_1.bvh")));
}

}  // namespace
}  // namespace strut::test
