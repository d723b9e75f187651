// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/program.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>
#include <strut/io/bvh.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The JSON that the page carries.
nlohmann::json page_data(const std::string& page) {
  const std::string mark = R"(<script type="application/json" id="data">)";
  const std::size_t begin = page.find(mark) + mark.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(Demo, LearnsALimpAndShowsItOnAPageOfItsOwn) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(STRUT_PROGRAM, {"demo", "-o", folder.file("made")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* name : {"normal_1.bvh", "limp_9.bvh", "pairs.toml", "limp.strut", "input.bvh", "truth.bvh"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.file("made/") + name)) << name;
  }

  const nlohmann::json data = page_data(read_file(folder.file("made/demo.html")));
  ASSERT_EQ(data.at("clips").size(), 3);
  const auto num_frames = data.at("clips").at(1).at("num_frames").get<std::size_t>();
  EXPECT_EQ(num_frames, read_bvh(folder.file("made/output.bvh")).motion.num_frames());
  EXPECT_EQ(data.at("clips").at(1).at("points").size(), 3 * data.at("parents").size() * num_frames);
  const auto& distance = data.at("figures").at(0).at("values");
  const auto cm = [&](std::size_t clip) { return std::stod(distance.at(clip).get<std::string>()); };
  EXPECT_LT(cm(1), 0.5 * cm(0));  // measured: 1.1 against 4.1
}

TEST(Demo, ItsPageAndPictureLoadNothing) {
  const std::string page = read_file(std::string(STRUT_TEST_SOURCE_DIR) + "/cli/demo_page.html");
  for (const char* reference : {"http:", "https:", "src=", "@import", "url(", "fetch("}) {
    EXPECT_THAT(page, Not(HasSubstr(reference)));
  }
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
