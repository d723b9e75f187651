// SPDX-License-Identifier: MIT
// One broken file per fault in tests/malformed, and what the person who meets it reads.
#include "support/data.h"

#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>

namespace strut {
namespace {

const std::map<std::string, std::string>& messages() {
  static const std::map<std::string, std::string> kMessages = {
      {"absurd_frame_count", ":17:9: error: expected a number of frames from 0 to 100000000, found '1000000000000'"},
      {"channels_after_child", ":14:2: error: expected 'JOINT', 'End Site' or '}', found 'CHANNELS'"},
      {"control_byte", ":20:3: error: expected a number, found '9\\x1b[2J1'"},
      {"decimal_comma", ":20:3: error: expected a number, found '91,5'"},
      {"empty", ":1:1: error: expected 'HIERARCHY', found end of file"},
      {"ends_in_hierarchy", ":10:1: error: expected 'JOINT', 'End Site' or '}', found end of file"},
      {"infinity_in_row", ":20:3: error: expected a finite number, found '-inf'"},
      {"nan_frame_time", ":18:13: error: expected a finite number, found 'nan'"},
      {"nan_in_row", ":20:3: error: expected a finite number, found 'nan'"},
      {"negative_frame_count", ":17:9: error: expected a number of frames from 0 to 100000000, found '-2'"},
      {"negative_frame_time", ":18:13: error: expected a frame time in seconds above zero, found '-0.0333333'"},
      {"no_channels", ":14:7: error: expected a skeleton with channels, found none"},
      {"no_closing_brace", ":15:1: error: expected 'JOINT', 'End Site' or '}', found 'MOTION'"},
      {"no_frame_count", ":17:1: error: expected 'Frames:', found 'Frame'"},
      {"no_frame_time", ":18:1: error: expected 'Frame Time:', found '0'"},
      {"no_motion", ":16:1: error: expected 'MOTION', found end of file"},
      {"no_offset", ":13:2: error: expected 'OFFSET', found '}'"},
      {"no_opening_brace", ":7:3: error: expected '{', found 'OFFSET'"},
      {"no_root", ":2:1: error: expected 'ROOT', found 'JOINT'"},
      {"not_bvh", ":1:1: error: expected 'HIERARCHY', found 'RIFF'"},
      {"number_out_of_range", ":20:3: error: expected a finite number, found '1e999'"},
      {"number_too_large", ":20:3: error: expected a number of at most 1e12, found '1e300'"},
      {"one_closing_brace_too_many", ":16:1: error: expected 'MOTION', found '}'"},
      {"only_row_cut_off", ":19:13: error: expected 9 numbers in the row (5 are there), found end of file"},
      {"overflowing_frame_count",
       ":17:9: error: expected a number of frames from 0 to 100000000, found '99999999999999999999999999'"},
      {"repeated_channel", ":9:24: error: expected a channel that is not listed yet, found 'Zrotation'"},
      {"row_too_long", ":19:23: error: expected end of line after 9 numbers, found '40'"},
      {"row_too_short", ":19:19: error: expected 9 numbers in the row (8 are there), found end of line"},
      {"seven_channels", ":5:11: error: expected a number of channels from 0 to 6, found '7'"},
      {"short_offset", ":8:14: error: expected a number, found end of line"},
      {"too_few_channel_names",
       ":9:33: error: expected a channel such as 'Xposition' or 'Zrotation', found end of line"},
      {"too_many_channel_names", ":9:34: error: expected 'JOINT', 'End Site' or '}', found 'Yrotation'"},
      {"two_frame_times", ":18:23: error: expected end of line, found '0.0333333'"},
      {"two_offsets", ":9:3: error: expected 'CHANNELS', 'JOINT', 'End Site' or '}', found 'OFFSET'"},
      {"two_roots", ":16:1: error: expected 'MOTION', found 'ROOT'"},
      {"unknown_channel", ":9:14: error: expected a channel such as 'Xposition' or 'Zrotation', found 'Wrotation'"},
      {"utf16", ":1:1: error: expected text in ASCII or UTF-8, found UTF-16"},
      {"word_as_frame_count", ":17:9: error: expected a number of frames from 0 to 100000000, found 'two'"},
      {"word_in_offset", ":8:12: error: expected a number, found 'fifty'"},
      {"word_in_row", ":20:3: error: expected a number, found 'abc'"},
      {"zero_byte", ":20:3: error: expected a number, found a zero byte"},
      {"zero_frame_time", ":18:13: error: expected a frame time in seconds above zero, found '0.0'"},
  };
  return kMessages;
}

std::string message_for(const std::string& text, const std::string& name) {
  try {
    parse_bvh(text, name);
  } catch (const ParseError& error) {
    return error.what();
  }
  return "no error";
}

class MalformedBvh : public testing::TestWithParam<std::pair<const std::string, std::string>> {};

TEST_P(MalformedBvh, IsRefusedWithPlaceAndReason) {
  const auto& [fault, message] = GetParam();
  const std::string name = fault + ".bvh";
  EXPECT_EQ(message_for(read_file(test::test_file("malformed/" + name)), name), name + message);
}

INSTANTIATE_TEST_SUITE_P(Faults, MalformedBvh, testing::ValuesIn(messages()),
                         [](const auto& fault) { return fault.param.first; });

TEST(MalformedBvhFolder, HasAMessageForEveryFile) {
  for (const auto& entry : std::filesystem::directory_iterator(test::test_file("malformed"))) {
    if (entry.path().extension() != ".bvh") continue;
    EXPECT_EQ(messages().count(entry.path().stem()), 1U) << entry.path();
  }
}

TEST(MalformedBvh, HintsAtWhatToDo) {
  try {
    read_bvh(test::test_file("malformed/two_roots.bvh"));
    FAIL() << "was read";
  } catch (const ParseError& error) {
    EXPECT_EQ(error.hint(), "a file holds one skeleton; split it in two");
  }
  try {
    read_bvh(test::test_file("malformed/decimal_comma.bvh"));
    FAIL() << "was read";
  } catch (const ParseError& error) {
    EXPECT_EQ(error.hint(), "write a decimal point, and blanks between numbers");
  }
}

TEST(MalformedBvh, CountsLettersAsColumnsNotBytes) {
  EXPECT_EQ(message_for("HIERARCHY\nROOT Br\xC3\xBCst { OFFSET x", "a"), "a:2:21: error: expected a number, found 'x'");
}

TEST(MalformedBvh, DoesNotCountTheByteOrderMarkAsAColumn) {
  EXPECT_EQ(message_for("\xEF\xBB\xBFhello", "a"), "a:1:1: error: expected 'HIERARCHY', found 'hello'");
}

TEST(MalformedBvh, QuotesOnlyTheBeginningOfALongWord) {
  EXPECT_EQ(message_for(std::string(1000, 'x'), "a"),
            "a:1:1: error: expected 'HIERARCHY', found '" + std::string(32, 'x') + "...'");
}

TEST(MalformedBvh, MayNestADeepHierarchyWithoutExhaustingTheStack) {
  constexpr int kDepth = 200'000;
  std::string text = "HIERARCHY\nROOT a\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation\n";
  for (int i = 0; i < kDepth; ++i) text += "JOINT a { OFFSET 0 0 0\n";
  EXPECT_EQ(message_for(text, "a"),
            "a:200004:1: error: expected 'CHANNELS', 'JOINT', 'End Site' or '}', found end of file");
  for (int i = 0; i <= kDepth; ++i) text += "}";
  EXPECT_EQ(parse_bvh(text + "\nMOTION\nFrames: 1\nFrame Time: 0.01\n5\n", "a").motion.skeleton().num_joints(),
            kDepth + 1);
}

TEST(MalformedBvh, ReservesNoMemoryForFramesThatTheTextCannotHold) {
  std::string text = read_file(test::test_file("data/two_joints.bvh"));
  text.replace(text.find("Frames: 2"), 9, "Frames: 100000000");  // as doubles: 7 GB
  const BvhClip clip = parse_bvh(text, "a");
  EXPECT_EQ(clip.motion.num_frames(), 2);
  EXPECT_LT(clip.layout.source_values->capacity(), 1000U);
}

TEST(MalformedBvh, EveryTruncationIsReadOrRefusedButNeverAnythingElse) {
  const std::string text = read_file(test::test_file("data/inner_positions.bvh"));
  int read = 0;
  for (std::size_t size = 0; size < text.size(); ++size) {
    try {
      read += parse_bvh(text.substr(0, size), "a").motion.num_frames() > 0 ? 1 : 0;
    } catch (const ParseError&) {
    }
  }
  EXPECT_GT(read, 100);
}

TEST(MissingBvh, IsAFileErrorThatNamesThePath) {
  EXPECT_THROW(read_bvh("/nowhere/at/all.bvh"), FileError);
}

}  // namespace
}  // namespace strut
