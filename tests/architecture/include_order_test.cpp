// SPDX-License-Identifier: MIT
// Who includes whom, held against the table; and the table held against the one people read.
#include "architecture/include_order.h"

#include "support/data.h"

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strut::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kRoot = STRUT_TEST_SOURCE_DIR;

IncludeOrder order() {
  return read_include_order(test_file("architecture/include_order.txt"));
}

TEST(IncludeOrder, IsKeptByEveryFile) {
  const IncludeReport report = check_includes(kRoot, order());
  EXPECT_THAT(report.violations, IsEmpty());
  EXPECT_GT(report.num_files, 80) << "the tree was not read";
  EXPECT_GT(report.num_includes, 5 * report.num_files / 2) << "the includes were not read";
}

TEST(IncludeOrder, FindsEveryPlantedViolation) {
  const IncludeReport report = check_includes(test_file("architecture/violation"), order());
  EXPECT_THAT(report.violations,
              ElementsAre("cli/reaches_into_tests.cpp:2: cli may not include tests (support/data.h)",
                          "include/strut/align/sees_a_skeleton.h:5: align may not include motion "
                          "(strut/motion/skeleton.h)",
                          "include/strut/model/shows_flatbuffers.h:5: a public header may not include flatbuffers "
                          "(flatbuffers/flatbuffers.h)",
                          "src/math/looks_up.cpp:2: \"math/missing.h\" is nowhere",
                          "src/math/looks_up.cpp:3: math may not include motion (motion/posture.h)",
                          "src/translate/parses_itself.cpp:2: translate may not include flatbuffers "
                          "(flatbuffers/flatbuffers.h)",
                          "src/unheard_of/stray.cpp: the table has no folder 'unheard_of'"));
  EXPECT_EQ(report.num_files, 8);
}

/// The rows of the table in docs/architecture.md: folder -> folders it may include.
std::map<std::string, std::string> documented_table() {
  static const std::regex kRow(R"(\| ([a-z_, ]+) \| ([a-z_ -]+) \|.*)");
  std::ifstream stream(kRoot + "/docs/architecture.md");
  std::map<std::string, std::string> rows;
  std::string line;
  while (std::getline(stream, line)) {
    std::smatch match;
    if (!std::regex_match(line, match, kRow)) continue;
    std::istringstream names(match[1]);
    std::string name;
    while (std::getline(names >> std::ws, name, ',')) rows[name] = match[2];
  }
  return rows;
}

TEST(IncludeOrder, IsTheOneTheArchitecturePageShows) {
  std::map<std::string, std::string> enforced;
  for (const auto& [folder, rule] : order()) {
    std::string text = rule.any_folder ? "any" : "";
    for (const std::string& name : rule.folders) text += (text.empty() ? "" : " ") + name;
    enforced[folder] = text.empty() ? "-" : text;
  }
  std::map<std::string, std::string> documented = documented_table();
  EXPECT_EQ(documented.erase("folder"), 1U) << "the table's head is gone";
  for (auto& [folder, names] : documented) {
    std::istringstream stream(names);
    std::set<std::string> sorted{std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
    names.clear();
    for (const std::string& name : sorted) names += (names.empty() ? "" : " ") + name;
  }
  enforced.erase("strut.h");  // the header that includes them all
  EXPECT_EQ(documented, enforced);
}

}  // namespace
}  // namespace strut::test
