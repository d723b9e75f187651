// SPDX-License-Identifier: MIT
// BVH row by row against whole files: the same poses, the same text, the same refusals, whatever pieces bytes come in.
#include "support/data.h"
#include "support/small_model.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/io/bvh_stream.h>

namespace strut {
namespace {

/// `text` in pieces of `piece` bytes.
ReadBytes pieces_of(const std::string& text, std::size_t piece) {
  return [&text, piece, begin = std::size_t{0}](char* to, std::size_t size) mutable {
    const std::size_t count = std::min({piece, size, text.size() - begin});
    std::memcpy(to, text.data() + begin, count);
    begin += count;
    return count;
  };
}

std::vector<Pose> all_rows(BvhRowReader& reader) {
  std::vector<Pose> frames;
  for (Pose pose; reader.next(pose);) frames.push_back(pose);
  return frames;
}

std::vector<std::string> texts_of(const char* folder) {
  std::vector<std::string> texts;
  for (const auto& entry : std::filesystem::directory_iterator(test::test_file(folder))) {
    if (entry.path().extension() == ".bvh") texts.push_back(read_file(entry.path().string()));
  }
  EXPECT_GT(texts.size(), 4U);
  return texts;
}

std::string with_crlf(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

std::vector<Diagnostic> sorted(std::vector<Diagnostic> entries) {
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.message < b.message; });
  return entries;
}

void expect_same_as_whole(const std::string& text, std::size_t piece) {
  Diagnostics of_whole, of_rows;
  const BvhClip whole = parse_bvh(text, "in", {}, &of_whole);
  BvhRowReader reader(pieces_of(text, piece), "in", {}, &of_rows);
  EXPECT_EQ(all_rows(reader), whole.motion.frames());
  EXPECT_EQ(reader.num_rows(), whole.motion.num_frames());
  EXPECT_EQ(reader.frame_rate(), whole.motion.frame_rate());
  EXPECT_EQ(reader.layout().header, whole.layout.header);
  EXPECT_EQ(reader.layout().line_end, whole.layout.line_end);
  EXPECT_EQ(reader.layout().unit, whole.layout.unit);
  EXPECT_EQ(reader.layout().up, whole.layout.up);
  const auto a = sorted(of_rows.entries()), b = sorted(of_whole.entries());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].where + a[i].message, b[i].where + b[i].message);
}

TEST(BvhRowReader, GivesWhatReadingTheWholeFileGivesInAnyPieces) {
  for (const std::string& text : texts_of("data")) {
    for (const std::size_t piece : {1, 7, 100000}) {
      expect_same_as_whole(text, piece);
      expect_same_as_whole(with_crlf(text), piece);
      expect_same_as_whole(text + "\n \t\n\r\n", piece);
      expect_same_as_whole(text.substr(0, text.find_last_not_of('\n') + 1), piece);  // no newline at the end
      expect_same_as_whole(text + text.substr(text.rfind('\n', text.size() - 2) + 1, 5), piece);  // a row cut off
    }
  }
}

std::string refusal(const std::string& text, std::size_t piece) {
  try {
    BvhRowReader reader(pieces_of(text, piece), "in");
    all_rows(reader);
  } catch (const ParseError& error) {
    return error.what();
  }
  return "no error";
}

std::string refusal(const std::string& text) {
  try {
    parse_bvh(text, "in");
  } catch (const ParseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BvhRowReader, RefusesWhatReadingTheWholeFileRefusesInTheSameWords) {
  for (const std::string& text : texts_of("malformed")) {
    EXPECT_NE(refusal(text), "no error");
    for (const std::size_t piece : {1, 5, 100000}) EXPECT_EQ(refusal(text, piece), refusal(text));
  }
}

TEST(BvhRowReader, TellsLinesAndColumnsOfLateRows) {
  const std::string text = read_file(test::test_file("data/two_joints.bvh"));
  const auto header_end = text.find('\n', text.find("Frame Time")) + 1;
  const std::string row = text.substr(header_end, text.find('\n', header_end) + 1 - header_end);
  std::string many = text.substr(0, header_end);
  const auto header_lines = std::count(many.begin(), many.end(), '\n');
  for (int i = 0; i < 1000; ++i) many += row + (i % 3 == 0 ? "\n" : "");
  const std::string message = refusal(many + "1 2 x", 10);
  EXPECT_THAT(message, testing::StartsWith("in:" + std::to_string(header_lines + 1000 + 334 + 1) +
                                           ":5: error: expected a number, found 'x'"));
}

TEST(BvhRowReader, AsksForNothingBeyondTheRowItGives) {
  const std::string text = read_file(test::test_file("data/person.bvh"));
  const auto header_end = text.find('\n', text.find("Frame Time")) + 1;
  std::size_t given = 0;
  // A line per call, as a live source writes them.
  const ReadBytes lines = [&](char* to, std::size_t) {
    const std::size_t count = text.find('\n', given) + 1 - given;
    std::memcpy(to, text.data() + given, count);
    given += count;
    return count;
  };
  BvhRowReader known(lines, "in", {.unit = LengthUnit::kCentimetre, .up = UpAxis::kY});
  EXPECT_EQ(given, header_end);
  given = 0;
  BvhRowReader guessed(lines, "in");
  std::size_t row_end = text.find('\n', header_end) + 1;
  EXPECT_EQ(given, row_end);
  for (Pose pose; row_end != 0 && guessed.next(pose); row_end = text.find('\n', row_end) + 1) {
    EXPECT_EQ(given, row_end);
    if (row_end == text.size()) break;
  }
}

TEST(BvhRowReader, TakesAClaimOfNoFramesAsNotKnowing) {
  std::string text = read_file(test::test_file("data/two_joints.bvh"));
  const auto count = text.find("Frames: ") + 8;
  text.replace(count, text.find('\n', count) - count, "0");
  Diagnostics diagnostics;
  EXPECT_GT(parse_bvh(text, "in", {}, &diagnostics).motion.num_frames(), 0);
  for (const Diagnostic& entry : diagnostics.entries()) EXPECT_EQ(entry.severity, Severity::kNote) << entry.message;
}

TEST(BvhRowReader, PassesOnWhatItsSourceThrows) {
  const std::string text = read_file(test::test_file("data/two_joints.bvh"));
  std::size_t calls = 0;
  BvhRowReader reader(
      [&](char* to, std::size_t) {
        if (calls++ > 0) throw FileError(FileAction::kRead, "in", "is gone");
        std::memcpy(to, text.data(), text.size());
        return text.size();
      },
      "in");
  EXPECT_THROW(all_rows(reader), FileError);
}

TEST(BvhRowReader, RefusesALineWithoutEnd) {
  const ReadBytes endless = [](char* to, std::size_t size) {
    std::memset(to, 'x', size);
    return size;
  };
  EXPECT_THROW(BvhRowReader(endless, "in"), FileError);
}

TEST(BvhRowWriter, MakesTheTextOfTheWholeFile) {
  for (const std::string& text : texts_of("data")) {
    const BvhClip clip = parse_bvh(text, "in");
    for (const BvhLayout& layout : {clip.layout, default_layout(clip.motion.skeleton())}) {
      BvhRowReader reader = BvhRowReader::of_text(text, "in");
      BvhRowWriter writer(reader.shared_skeleton(), reader.frame_rate(), layout);
      std::string rows = writer.header(clip.motion.num_frames());
      for (Pose pose; reader.next(pose);) {
        rows += layout.source_values ? writer.row(pose, reader.row()) : writer.row(pose);
      }
      EXPECT_EQ(rows, format_bvh(clip.motion, layout));
    }
  }
}

TEST(BvhRowWriter, RefusesWhatDoesNotFit) {
  const Motion motion = test::turning_motion(30.0, 0.2);
  const BvhLayout layout = default_layout(motion.skeleton());
  EXPECT_THROW(BvhRowWriter(nullptr, 30.0, layout), InvalidArgument);
  EXPECT_THROW(BvhRowWriter(motion.shared_skeleton(), 0.0, layout), InvalidArgument);
  EXPECT_THROW(BvhRowWriter(motion.shared_skeleton(), 30.0, BvhLayout{}), InvalidArgument);
  BvhRowWriter writer(motion.shared_skeleton(), 30.0, layout);
  const std::vector<double> short_row(3);
  EXPECT_THROW(writer.row(Pose{}), InvalidArgument);
  EXPECT_THROW(writer.row(motion.frame(0), short_row), InvalidArgument);
}

}  // namespace
}  // namespace strut
