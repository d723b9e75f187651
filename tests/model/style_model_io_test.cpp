// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/small_model.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/model/style_model_io.h>
#include <strut/translate/translate_motion.h>

namespace strut {
namespace {

std::string small_file() {
  return format_style_model(*test::copying_model(test::turning_motion(30.0, 1.0), 0.1));
}

TEST(StyleModelFile, GivesBackTheModelToTheBit) {
  const Motion clip = test::turning_motion(30.0, 2.0);
  const auto model = test::copying_model(clip, 0.1);
  const auto back = parse_style_model(format_style_model(*model), "a.strut");
  EXPECT_EQ(back->provenance(), model->provenance());
  EXPECT_EQ(back->blocks().size(), model->blocks().size());
  EXPECT_EQ(describe_mismatch(back->skeleton(), model->skeleton()), "");
  const Motion a = translate_motion(model, clip);
  const Motion b = translate_motion(back, clip);
  EXPECT_EQ(a.frames(), b.frames());
  EXPECT_EQ(format_style_model(*back), format_style_model(*model));
}

TEST(StyleModelFile, RefusesOtherFiles) {
  EXPECT_FALSE(is_style_model(""));
  EXPECT_FALSE(is_style_model("HIERARCHY\nROOT a\n"));
  EXPECT_TRUE(is_style_model(small_file()));
  try {
    parse_style_model("HIERARCHY\nROOT a\n", "walk.bvh");
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(),
                 "walk.bvh: error: expected a style model made by strut learn, found another kind of file");
  }
}

TEST(StyleModelFile, RefusesEveryTruncation) {
  const std::string bytes = small_file();
  constexpr std::size_t kPadding = 8;  // of a file's end at most
  for (std::size_t size = 0; size + kPadding <= bytes.size(); size += 7) {
    EXPECT_THROW(parse_style_model(bytes.substr(0, size), "cut.strut"), Error) << size;
  }
}

TEST(StyleModelFile, NeverCrashesOnDamagedBytes) {
  const std::string bytes = small_file();
  std::mt19937 random(3);
  for (int trial = 0; trial < 3000; ++trial) {
    std::string damaged = bytes;
    for (int hits = 0; hits < 3; ++hits) damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      parse_style_model(damaged, "damaged.strut");
    } catch (const Error&) {
      continue;  // refused; a hit in a number or a name may as well be read
    }
  }
}

TEST(StyleModelFile, RefusesAnotherFormatVersion) {
  std::string bytes = small_file();
  // The only 32-bit 2 that, made a 99, turns the refusal into one of the version is the version itself.
  bool found = false;
  for (std::size_t i = 0; i + 4 <= bytes.size() && !found; i += 4) {
    if (bytes.compare(i, 4, std::string("\x02\0\0\0", 4)) != 0) continue;
    std::string changed = bytes;
    changed[i] = 99;
    try {
      parse_style_model(changed, "new.strut");
    } catch (const VersionError& error) {
      found = true;
      EXPECT_STREQ(error.what(), "new.strut: error: the file has format version 99, this strut reads version 2");
    } catch (const Error&) {
      continue;
    }
  }
  EXPECT_TRUE(found);
}

TEST(StyleModelFile, OfAMissingPathIsAFileError) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(read_style_model(folder.file("none.strut")), FileError);
}

}  // namespace
}  // namespace strut
