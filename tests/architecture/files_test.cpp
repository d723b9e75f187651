// SPDX-License-Identifier: MIT
// What every file of the project has: its licence in the first lines, and a length one can read.
#include "support/data.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strut::test {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

constexpr int kMaxLines = 500;     // above, a file wants splitting
constexpr int kLicenceWithin = 2;  // lines: a script's first is its interpreter

bool is_source(const fs::path& path) {
  static const std::set<std::string> kExtensions = {".h",  ".cpp", ".c",  ".cmake", ".fbs",
                                                    ".sh", ".py",  ".ts", ".tsx",   ".css"};
  return kExtensions.contains(path.extension().string()) || path.filename() == "CMakeLists.txt" ||
         path.filename() == "dev" || path == ".ci/run";
}

std::vector<fs::path> sources() {
  const fs::path root = STRUT_TEST_SOURCE_DIR;
  std::vector<fs::path> files = {root / "CMakeLists.txt", root / "dev", root / ".ci/run",
                                 root / "viewer/vite.config.ts"};
  for (const char* top :
       {"include", "src", "cli", "bench", "tests", "examples", "cmake", "viewer/src", "viewer/tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.is_regular_file() && is_source(entry.path())) files.push_back(entry.path());
    }
  }
  return files;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool states_its_licence(const std::vector<std::string>& lines) {
  const auto end = lines.begin() + std::min<std::ptrdiff_t>(kLicenceWithin, std::ssize(lines));
  return std::any_of(lines.begin(), end, [](const std::string& line) {
    return line.find("SPDX-License-Identifier: MIT") != std::string::npos;
  });
}

TEST(SourceFiles, StateTheirLicenceInTheFirstLines) {
  std::vector<std::string> without;
  const auto files = sources();
  for (const fs::path& file : files) {
    if (!states_its_licence(lines_of(file))) without.push_back(file.string());
  }
  EXPECT_GT(files.size(), 80U);
  EXPECT_THAT(without, IsEmpty());
}

TEST(SourceFiles, AreSeenToLackALicence) {
  EXPECT_FALSE(states_its_licence({}));
  EXPECT_FALSE(states_its_licence({"#pragma once", "", "// SPDX-License-Identifier: MIT"}));
  EXPECT_FALSE(states_its_licence({"// SPDX-License-Identifier: GPL-3.0-only"}));
}

TEST(SourceFiles, CanBeReadInOneSitting) {
  std::vector<std::string> long_files;
  for (const fs::path& file : sources()) {
    const auto count = lines_of(file).size();
    if (count > kMaxLines) long_files.push_back(file.string() + ": " + std::to_string(count) + " lines");
  }
  EXPECT_THAT(long_files, IsEmpty());
}

}  // namespace
}  // namespace strut::test
