// SPDX-License-Identifier: MIT
#include "support/data.h"

#include <sstream>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/pair_list.h>

namespace strut {
namespace {

const char* const kList = R"(# made by hand
[[pair]]
input = "normal_001.bvh"
output = "styles/elderly 001.bvh"
input_frames = [30, 96]
output_frames = [41, 104]

[[pair]]
output = "/clips/elderly_002.bvh"
input = "../normal_002.bvh"
)";

TEST(PairList, ReadsPathsRelativeToItsOwnFolder) {
  const auto pairs = parse_pair_list(kList, "work/lists/pairs.toml");
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].input.path, "work/lists/normal_001.bvh");
  EXPECT_EQ(pairs[0].output.path, "work/lists/styles/elderly 001.bvh");
  EXPECT_EQ(pairs[0].input.frames, (motion::FrameRange{30, 96}));
  EXPECT_EQ(pairs[0].output.frames, (motion::FrameRange{41, 104}));
  EXPECT_EQ(pairs[1].input.path, "work/normal_002.bvh");
  EXPECT_EQ(pairs[1].output.path, "/clips/elderly_002.bvh");
  EXPECT_FALSE(pairs[1].input.frames.has_value());
  EXPECT_EQ(pairs[0].input.line, 5U);
  EXPECT_EQ(pairs[0].input.column, 16U);
}

TEST(PairList, IsReadBackAsWritten) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("pairs.toml");
  PairListEntry odd;
  odd.input = {folder.file("a \"quoted\" \\ näme\t.bvh"), motion::FrameRange{0, 1}};
  odd.output = {"/elsewhere/b.bvh", std::nullopt};
  odd.comment = "left cycle: 1.2 m/s\n[[pair]] in a comment is none";
  PairListEntry plain;
  plain.input = {folder.path() + "/sub/c.bvh", std::nullopt};
  plain.output = {folder.file("d.bvh"), motion::FrameRange{3, 99}};
  write_pair_list(path, {odd, plain}, "heading\n\nin lines");
  const auto pairs = read_pair_list(path);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].input.path, odd.input.path);
  EXPECT_EQ(pairs[0].input.frames, odd.input.frames);
  EXPECT_EQ(pairs[0].output.frames, odd.output.frames);
  EXPECT_EQ(pairs[1].input.path, plain.input.path);
  EXPECT_EQ(pairs[1].output.path, plain.output.path);
  EXPECT_EQ(pairs[1].output.frames, plain.output.frames);
  const std::string text = read_file(path);
  EXPECT_EQ(text.rfind("# heading\n#\n# in lines\n", 0), 0U);
  EXPECT_NE(text.find("input = \"sub/c.bvh\""), std::string::npos);
  EXPECT_THROW(write_pair_list(path, pairs), FileError);  // it is there already
}

const char* const kAnnotated = R"(# What this list is.
#
#   with an indented "line" # and another mark

# left cycle; distance 0.05
# accepted
[[pair]]
input = "a#1.bvh"   # quoted marks begin no comment
output = """
b#2.bvh"""
# between the keys

# of the second

# after a gap
[[pair]]
input = 'c"#.bvh'
output = "d\"#.bvh"
input_frames = [1, # begin
  9]
# at the end
)";

TEST(PairList, KeepsEveryComment) {
  const PairList list = parse_annotated_pair_list(kAnnotated, "p.toml");
  EXPECT_EQ(list.heading, "What this list is.\n\n  with an indented \"line\" # and another mark");
  ASSERT_EQ(list.pairs.size(), 2U);
  EXPECT_EQ(list.pairs[0].comment, "left cycle; distance 0.05\naccepted\nquoted marks begin no comment");
  EXPECT_EQ(list.pairs[1].comment, "between the keys\n\nof the second\n\nafter a gap\nbegin");
  EXPECT_EQ(list.ending, "at the end");
  EXPECT_TRUE(list.rejected.empty());
}

void expect_same(const std::vector<PairListEntry>& a, const std::vector<PairListEntry>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].comment, b[i].comment);
    EXPECT_EQ(a[i].input.path, b[i].input.path);
    EXPECT_EQ(a[i].output.path, b[i].output.path);
    EXPECT_EQ(a[i].input.frames, b[i].input.frames);
    EXPECT_EQ(a[i].output.frames, b[i].output.frames);
  }
}

TEST(PairList, WithCommentsAndRejectedPairsIsReadBackAsWritten) {
  PairList list = parse_annotated_pair_list(kAnnotated, "p.toml");
  list.rejected = {list.pairs[1]};
  list.rejected.push_back(list.pairs[0]);
  list.pairs.pop_back();
  const std::string text = format_pair_list(list, "p.toml");
  const PairList again = parse_annotated_pair_list(text, "p.toml");
  EXPECT_EQ(again.heading, list.heading);
  EXPECT_EQ(again.ending, list.ending);
  expect_same(again.pairs, list.pairs);
  expect_same(again.rejected, list.rejected);
  EXPECT_EQ(format_pair_list(again, "p.toml"), text);
  EXPECT_EQ(parse_pair_list(text, "p.toml").size(), 1U);  // what is learnt from
}

TEST(PairList, RejectedPairComesBackWhenItsMarksAreTakenAway) {
  PairList list = parse_annotated_pair_list(kAnnotated, "p.toml");
  list.rejected = {list.pairs[1]};
  list.pairs.pop_back();
  const std::string text = format_pair_list(list, "p.toml");
  const std::string mark = "# [[pair]]";
  std::string freed = text.substr(0, text.find(mark));
  std::istringstream rest(text.substr(freed.size()));
  for (std::string line; std::getline(rest, line);) freed += line.substr(2) + "\n";
  EXPECT_EQ(parse_pair_list(freed, "p.toml").size(), 2U);
}

TEST(PairList, LeavesWordsThatAreNoPairsAtTheEndAsTheyAre) {
  const PairList rejected{{}, parse_pair_list(kList, "p.toml"), parse_pair_list(kList, "p.toml"), {}};
  const std::string text = format_pair_list(rejected, "p.toml") + "# and here a person wrote a line\n";
  const PairList list = parse_annotated_pair_list(text, "p.toml");
  EXPECT_TRUE(list.rejected.empty());
  EXPECT_NE(list.ending.find("[[pair]]"), std::string::npos);
  EXPECT_EQ(format_pair_list(list, "p.toml"), text);
}

struct Fault {
  const char* text;
  const char* message;
};

class PairListFaults : public testing::TestWithParam<Fault> {};

TEST_P(PairListFaults, AreNamedWithLineAndColumn) {
  try {
    parse_pair_list(GetParam().text, "p.toml");
    FAIL() << "read without complaint";
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(), GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, PairListFaults,
    testing::Values(
        Fault{"", "p.toml: error: expected at least one '[[pair]]', found none"},
        Fault{"pair = []", "p.toml:1:8: error: expected at least one '[[pair]]', found none"},
        Fault{"[pair]\ninput = \"a\"", "p.toml:1:1: error: expected '[[pair]]' for every pair, found a table"},
        Fault{"[[pairs]]\n", "p.toml:1:3: error: expected '[[pair]]', found 'pairs'"},
        Fault{"[[pair]]\ninput = \"a\"\n", "p.toml:1:1: error: expected 'output' in this pair, found none"},
        Fault{"[[pair]]\ninput = 3\noutput = \"b\"\n",
              "p.toml:2:9: error: expected a file name in quotes after 'input =', found an integer"},
        Fault{"[[pair]]\ninput = \"\"\noutput = \"b\"\n",
              "p.toml:2:9: error: expected a file name, found an empty string"},
        Fault{"[[pair]]\ninput = \"a\"\noutput = \"b\"\nframes = [1, 2]\n",
              "p.toml:4:1: error: expected 'input', 'output', 'input_frames' or 'output_frames', found 'frames'"},
        Fault{"[[pair]]\ninput = \"a\"\noutput = \"b\"\ninput_frames = 7\n",
              "p.toml:4:16: error: expected two whole numbers: [first, end), found an integer"},
        Fault{"[[pair]]\ninput = \"a\"\noutput = \"b\"\ninput_frames = [7]\n",
              "p.toml:4:16: error: expected two whole numbers: [first, end), found 1"},
        Fault{"[[pair]]\ninput = \"a\"\noutput = \"b\"\ninput_frames = [1.5, 7]\n",
              "p.toml:4:17: error: expected a whole number, found a number with a fraction"},
        Fault{"[[pair]]\ninput = \"a\"\noutput = \"b\"\ninput_frames = [-1, 7]\n",
              "p.toml:4:17: error: expected a frame, from 0, found -1"},
        Fault{"[[pair]]\ninput = \"a\"\noutput = \"b\"\noutput_frames = [9, 7]\n",
              "p.toml:4:21: error: expected an end after frame 9, found 7"},
        Fault{"[[pair]]\ninput = \"a\"\noutput = \"b\"\noutput_frames = [0, 99999999999]\n",
              "p.toml:4:21: error: expected a frame, found 99999999999"}));

TEST(PairList, SaysWhereTextIsNotToml) {
  try {
    parse_pair_list("[[pair]]\ninput = normal.bvh\n", "p.toml");
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_EQ(error.line(), 2U);
    EXPECT_EQ(error.expected(), "a file name in quotes or whole numbers");
  }
}

TEST(PairList, RefusesHeadersWithoutAName) {
  using namespace std::string_literals;  // with their zeros
  for (const std::string& text : {"[[\0"s, "[[="s, "[=]"s, "[[pair.=]]"s, "[["s, "["s, "[[pair"s, "[[pair]"s, "\0"s}) {
    EXPECT_THROW(parse_pair_list(text, "p.toml"), ParseError) << text;
  }
}

TEST(PairList, ChecksFramesAgainstTheClip) {
  const auto pairs = parse_pair_list(kList, "pairs.toml");
  EXPECT_EQ(frames_within(pairs[0].input, 96, "pairs.toml"), (motion::FrameRange{30, 96}));
  EXPECT_EQ(frames_within(pairs[1].input, 12, "pairs.toml"), (motion::FrameRange{0, 12}));
  try {
    frames_within(pairs[0].input, 95, "pairs.toml");
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(),
                 "pairs.toml:5:16: error: expected frames within 0 and 95, as 'normal_001.bvh' has, found 30 to 96");
  }
  EXPECT_THROW(frames_within(pairs[1].input, 0, "pairs.toml"), ParseError);
}

TEST(PairList, IsNotWrittenEmptyOrReversed) {
  EXPECT_THROW(format_pair_list(std::vector<PairListEntry>{}, "p.toml"), InvalidArgument);
  PairListEntry reversed;
  reversed.input = {"a.bvh", motion::FrameRange{5, 5}};
  reversed.output = {"b.bvh", std::nullopt};
  EXPECT_THROW(format_pair_list({reversed}, "p.toml"), InvalidArgument);
}

TEST(PairList, ThatIsMissingIsAFileError) {
  EXPECT_THROW(read_pair_list("/nowhere/pairs.toml"), FileError);
}

}  // namespace
}  // namespace strut
