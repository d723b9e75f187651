// SPDX-License-Identifier: MIT
// strut translate --stream and --follow: what comes out, when, and how they end.
#include "support/live_program.h"
#include "support/program.h"
#include "support/small_model.h"
#include "support/walks.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model_io.h>
#include <strut/motion/resample.h>

namespace strut::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif
#else
constexpr bool kIsSanitized = false;
#endif

class TranslateStream : public testing::Test {
 protected:
  TranslateStream() {
    write_clip(here_.file("walk.bvh"), walk_);
    write_style_model(here_.file("style.strut"), StyleModel(exaggerating_parts(walk_, 0.3, 1.5)));
    write_style_model(here_.file("radial.strut"), StyleModel(radial_parts(walk_)));
    text_ = read_file(here_.file("walk.bvh"));
    header_ = text_.substr(0, text_.find('\n', text_.find("Frame Time")) + 1);
    for (std::size_t begin = header_.size(), end = 0; begin < text_.size(); begin = end) {
      end = text_.find('\n', begin) + 1;
      rows_.push_back(text_.substr(begin, end - begin));
    }
  }
  /// The same as a whole clip.
  std::string whole(std::vector<std::string> options = {}, const std::string& model = "@style.strut") {
    options.insert(options.begin(), {"translate", model, "@walk.bvh", "-o", "@whole.bvh", "--no-retime",
                                     "--no-clean-feet", "--warm-up", "0", "--force"});
    EXPECT_EQ(here_.run(STRUT_PROGRAM, options).exit_code, 0);
    return read_file(here_.file("whole.bvh"));
  }
  /// Standard input is `text`.
  ProgramResult stream(const std::string& text, std::vector<std::string> options = {},
                       const std::string& model = "style.strut") {
    write_file(here_.file("in.bvh"), text, Overwrite::kAllow);
    std::string command = "'" STRUT_PROGRAM "' translate '" + here_.file(model) + "' --stream";
    for (const std::string& option : options) command += " '" + option + "'";
    return run_program("/bin/sh", {"-c", command + " < '" + here_.file("in.bvh") + "'"});
  }
  std::vector<std::string> live(std::vector<std::string> options) const {
    options.insert(options.begin(), {"translate", here_.file("style.strut")});
    return options;
  }
  static std::string read_header(LiveProgram& program) {
    std::string header;
    do {
      header += program.read_line();
    } while (header.find("Frame Time") == header.npos && header.find("(silence)") == header.npos);
    return header;
  }
  [[nodiscard]] static std::string error_line(const std::string& err) {
    const auto place = err.find("error");
    return place == err.npos ? err : err.substr(err.rfind('\n', place) + 1);
  }

  Workplace here_;
  Motion walk_ = short_walk(0.0, 2.0);
  std::string text_, header_;
  std::vector<std::string> rows_;
};

TEST_F(TranslateStream, GivesWhatTheWholeClipGivesToTheDigit) {
  for (const char* model : {"style.strut", "radial.strut"}) {
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
             {}, {"--strength", "0.7"}, {"--keep-layout"}, {"--keep-layout", "--part", "left_arm=0"}}) {
      const ProgramResult result = stream(text_, options, model);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(result.out, whole(options, "@" + std::string(model)));
    }
  }
}

TEST_F(TranslateStream, TakesACommonFileApartByLinesOfAnyKind) {
  std::string crlf, blank = header_;
  for (const char c : text_) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& row : rows_) blank += row + " \n\n";
  const std::string expected = whole();
  EXPECT_EQ(stream(crlf).out, expected);
  EXPECT_EQ(stream(blank).out, expected);
  EXPECT_EQ(stream(text_.substr(0, text_.size() - 1)).out, expected);  // no newline at the end
}

TEST_F(TranslateStream, GivesARowForEveryRowAtOnce) {
  LiveProgram program(STRUT_PROGRAM, live({"--stream"}));
  program.write(header_ + rows_[0]);
  std::string out = read_header(program);
  out += program.read_line();
  for (std::size_t row = 1; row < rows_.size(); ++row) {
    EXPECT_TRUE(row > 3 || program.is_silent()) << row;
    program.write(rows_[row].substr(0, 10));
    program.write(rows_[row].substr(10));
    out += program.read_line();
  }
  program.close_input();
  EXPECT_EQ(program.exit_code(), 0);
  EXPECT_EQ(out, whole());
}

TEST_F(TranslateStream, GivesTheHeaderBeforeAnyRowWhereNothingIsToBeGuessed) {
  LiveProgram program(STRUT_PROGRAM, live({"--stream", "--unit", "cm", "--up", "y"}));
  program.write(header_);
  EXPECT_THAT(read_header(program), HasSubstr("Frame Time"));
  EXPECT_TRUE(program.is_silent());
  program.close_input();
  EXPECT_EQ(program.exit_code(), 0);
}

TEST_F(TranslateStream, PassesTheNumberOfFramesOnAndReadsItsOwnUnknownNumber) {
  const auto claim = text_.find("Frames: ") + 8;
  const std::string number = text_.substr(claim, text_.find('\n', claim) - claim);
  EXPECT_THAT(stream(text_).out, HasSubstr("Frames: " + number + "\n"));
  std::string unknown = text_;
  unknown.replace(claim, number.size(), "0");
  const ProgramResult result = stream(unknown);
  EXPECT_THAT(result.out, HasSubstr("Frames: 0\n"));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("warning")));
  EXPECT_EQ(parse_bvh(result.out, "out").motion.num_frames(), walk_.num_frames());
  std::string wrong = text_;
  wrong.replace(claim, number.size(), "7");
  EXPECT_THAT(stream(wrong).err, HasSubstr("the header says 7 frames, the file holds " + number));
}

TEST_F(TranslateStream, RefusesAMalformedRowAfterGivingAllBeforeIt) {
  const ProgramResult result = stream(header_ + rows_[0] + rows_[1] + "1 2 x\n" + rows_[2]);
  EXPECT_EQ(result.exit_code, 3);
  const auto line = std::count(header_.begin(), header_.end(), '\n') + 3;
  EXPECT_EQ(error_line(result.err), "<stdin>:" + std::to_string(line) + ":5: error: expected a number, found 'x'\n");
  const std::string expected = whole();
  EXPECT_EQ(result.out, expected.substr(0, result.out.size()));
  EXPECT_EQ(parse_bvh(result.out, "out").motion.num_frames(), 2);
}

TEST_F(TranslateStream, LeavesARowThatIsCutOffOut) {
  const ProgramResult result = stream(header_ + rows_[0] + rows_[1].substr(0, 12));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("the last row is cut off"));
  EXPECT_EQ(parse_bvh(result.out, "out").motion.num_frames(), 1);
}

TEST_F(TranslateStream, RefusesAnotherFrameRateOrSkeletonAndMakesNothing) {
  write_clip(here_.file("fast.bvh"), motion::resample(walk_, 60.0));
  const ProgramResult fast = stream(read_file(here_.file("fast.bvh")));
  EXPECT_EQ(fast.exit_code, 3);
  EXPECT_THAT(fast.err, AllOf(HasSubstr("<stdin>: error: runs at 60 frames per second, the model at 30, and a stream "
                                        "is not resampled"),
                              HasSubstr("hint: ")));
  write_clip(here_.file("tail.bvh"), renamed(walk_, 4, "Tail"));
  const ProgramResult tail = stream(read_file(here_.file("tail.bvh")), {"-o", here_.file("out.bvh")});
  EXPECT_EQ(tail.exit_code, 4);
  EXPECT_THAT(tail.err, HasSubstr("<stdin>: error: the skeleton does not fit"));
  EXPECT_EQ(fast.out + tail.out, "");
  EXPECT_EQ(here_.entries().count("out.bvh"), 0U);
}

TEST_F(TranslateStream, WritesAFileThatGrowsAndDoesNotOverwriteUnasked) {
  const std::vector<std::string> to_file{"-o", here_.file("out.bvh")};
  EXPECT_EQ(stream(text_, to_file).exit_code, 0);
  EXPECT_EQ(read_file(here_.file("out.bvh")), whole());
  EXPECT_EQ(stream(text_, to_file).exit_code, 1);
  EXPECT_EQ(stream(text_, {"-o", here_.file("out.bvh"), "--force"}).exit_code, 0);
  LiveProgram program(STRUT_PROGRAM, live({"--stream", "-o", here_.file("growing.bvh")}));
  program.write(header_ + rows_[0] + rows_[1]);
  const auto frames = [&] {
    try {
      return read_bvh(here_.file("growing.bvh")).motion.num_frames();
    } catch (const std::exception&) {
      return 0;  // not there yet, or its header is not
    }
  };
  for (int i = 0; i < 1000 && frames() < 2; ++i) EXPECT_TRUE(program.is_silent());
  EXPECT_EQ(frames(), 2);
}

TEST_F(TranslateStream, EndsCleanlyWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    LiveProgram program(STRUT_PROGRAM, live({"--stream"}));
    program.write(header_ + rows_[0] + rows_[1] + rows_[2].substr(0, 20));
    read_header(program);
    const std::string first = program.read_line(), second = program.read_line();
    program.send(signal);
    EXPECT_EQ(program.exit_code(), 0);
    EXPECT_EQ(program.read_line(), "");  // no part of a row
    EXPECT_THAT(program.err(), testing::Not(HasSubstr("error")));
  }
}

TEST_F(TranslateStream, EndsCleanlyWhenInterruptedWithNobodyReading) {
  LiveProgram program(STRUT_PROGRAM, live({"--stream"}));
  std::string many = header_;
  for (int i = 0; i < 20; ++i) {
    for (const std::string& row : rows_) many += row;
  }
  // More than both pipes hold: it must be waiting to write when the signal comes.
  std::thread writer([&] { program.write_what_is_taken(many); });
  EXPECT_FALSE(program.is_silent());
  program.send(SIGINT);
  EXPECT_EQ(program.exit_code(), 0);
  writer.join();
  std::string out, line;
  while (!(line = program.read_line()).empty()) out += line;
  EXPECT_EQ(out.back(), '\n');
}

TEST_F(TranslateStream, EndsCleanlyWhenNobodyReadsAnyMore) {
  LiveProgram program(STRUT_PROGRAM, live({"--stream"}));
  program.write(header_ + rows_[0]);
  read_header(program);
  program.close_output();
  program.write(rows_[1] + rows_[2]);
  EXPECT_EQ(program.exit_code(), 0);
  EXPECT_THAT(program.err(), testing::Not(HasSubstr("error")));
}

TEST_F(TranslateStream, SaysWhenItsOutputCannotBeWritten) {
  const ProgramResult result = stream(text_, {"-o", "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("/dev/full: error: cannot write: "));
}

TEST_F(TranslateStream, FollowsAFileUntilAllItClaimsIsThere) {
  std::ofstream growing(here_.file("growing.bvh"));
  growing << header_.substr(0, 100) << std::flush;
  LiveProgram program(STRUT_PROGRAM, live({"--follow", here_.file("growing.bvh")}));
  EXPECT_TRUE(program.is_silent());
  growing << header_.substr(100) << rows_[0] << std::flush;
  std::string out = read_header(program);
  out += program.read_line();
  for (std::size_t row = 1; row < rows_.size(); ++row) {
    growing << rows_[row] << std::flush;
    out += program.read_line();
  }
  EXPECT_EQ(program.exit_code(), 0);
  EXPECT_EQ(out, whole());
}

TEST_F(TranslateStream, FollowsAFileUntilItNoLongerGrows) {
  write_file(here_.file("growing.bvh"), header_ + rows_[0] + rows_[1]);
  const ProgramResult result =
      here_.run(STRUT_PROGRAM, {"translate", "@style.strut", "--follow", "@growing.bvh", "--until-idle", "0.1"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(parse_bvh(result.out, "out").motion.num_frames(), 2);
  LiveProgram program(STRUT_PROGRAM, live({"--follow", here_.file("growing.bvh")}));
  read_header(program);
  program.read_line();
  program.read_line();
  EXPECT_TRUE(program.is_silent());
  std::filesystem::resize_file(here_.file("growing.bvh"), 10);
  EXPECT_EQ(program.exit_code(), 3);
  EXPECT_THAT(program.err(), HasSubstr("became shorter while it was followed"));
}

TEST_F(TranslateStream, HoldsFeetWithAConstantLagAndGivesAllRowsInTheEnd) {
  constexpr std::size_t kLag = 9;  // 0.3 s
  StyleModelParts parts = radial_parts(walk_);
  const postprocess::FootplantBoundary alternating{Eigen::VectorXd::Ones(parts.radial_map->basis.num_features()), 0.0};
  parts.footplants = postprocess::FootplantClassifier({alternating, alternating});
  write_style_model(here_.file("planting.strut"), StyleModel(std::move(parts)));
  LiveProgram program(STRUT_PROGRAM, {"translate", here_.file("planting.strut"), "--stream", "--clean-feet"});
  program.write(header_);
  for (std::size_t row = 0; row < kLag; ++row) program.write(rows_[row]);
  read_header(program);
  EXPECT_TRUE(program.is_silent());
  for (std::size_t row = kLag; row < rows_.size(); ++row) {
    program.write(rows_[row]);
    EXPECT_THAT(program.read_line(), testing::EndsWith("\n")) << row;
  }
  EXPECT_TRUE(program.is_silent());
  program.close_input();
  std::size_t rest = 0;
  while (!program.read_line().empty()) ++rest;
  EXPECT_EQ(rest, kLag);
  EXPECT_EQ(program.exit_code(), 0);
  // What came before an interrupt or an error comes out too.
  const ProgramResult broken = stream(header_ + rows_[0] + rows_[1] + "x\n", {"--clean-feet"}, "planting.strut");
  EXPECT_EQ(broken.exit_code, 3);
  EXPECT_EQ(parse_bvh(broken.out, "out").motion.num_frames(), 2);
  const ProgramResult cannot = stream(text_, {"--clean-feet"}, "radial.strut");
  EXPECT_EQ(cannot.exit_code, 1);
  EXPECT_THAT(cannot.err, HasSubstr("hint: "));
}

TEST_F(TranslateStream, RefusesOptionsThatNeedAWholeClip) {
  EXPECT_EQ(stream(text_, {"--warm-up", "0.2"}).exit_code, 2);
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"@walk.bvh", "--follow", "@walk.bvh"}, {"--until-idle", "1"}, {}, {"@walk.bvh"}, {"-o", "@out.bvh"}}) {
    std::vector<std::string> words{"translate", "@style.strut"};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(here_.run(STRUT_PROGRAM, words).exit_code, 2);
  }
}

TEST_F(TranslateStream, HoldsNoMoreOfALongStreamThanOfAShortOne) {
  if (kIsSanitized) GTEST_SKIP() << "the address sanitizer keeps freed memory for a while";
  constexpr long kNoise = 1L << 20;  // a page here and there [bytes]; 20,000 rows are 25 MB of text
  const auto peak = [&](int repeats) {
    LiveProgram program(STRUT_PROGRAM, live({"--stream", "-o", "/dev/null"}));
    std::string all;
    for (const std::string& row : rows_) all += row;
    program.write(header_);
    for (int i = 0; i < repeats; ++i) program.write(all);
    program.close_input();
    EXPECT_EQ(program.exit_code(), 0);
    return program.peak_memory();
  };
  const long of_short = peak(1);
  EXPECT_LT(peak(300), of_short + kNoise);
}

}  // namespace
}  // namespace strut::test
