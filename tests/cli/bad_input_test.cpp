// SPDX-License-Identifier: MIT
// What every command has in common when something is wrong: one clear message, the right exit code, and nothing left
// behind; with arguments that make no sense, files that cannot be read, disks that are full, and signals.
#include "support/program.h"
#include "support/small_model.h"
#include "support/walks.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model_io.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Words = std::vector<std::string>;

class BadInput : public testing::Test {
 protected:
  BadInput() {
    write_clip(here_.file("walk.bvh"), walk_);
    write_style_model(here_.file("copy.strut"), *copying_model(walk_));
    write_file(here_.file("pairs.toml"), "[[pair]]\ninput = \"walk.bvh\"\noutput = \"walk.bvh\"\n");
    std::string table = "u,y\n";
    for (int row = 0; row < 40; ++row) table += std::to_string(row % 3) + "," + std::to_string(row % 5) + "\n";
    write_file(here_.file("table.csv"), table);
    before_ = here_.entries();
  }
  ProgramResult run(const Words& arguments) { return here_.run(STRUT_PROGRAM, arguments); }
  /// Through a shell that does `preparation` first.
  ProgramResult run_after(const std::string& preparation, const Words& arguments) {
    Words command{"-c", preparation + R"(; exec "$0" "$@")", STRUT_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return here_.run("/bin/sh", command);
  }
  [[nodiscard]] bool left_nothing() const { return here_.entries() == before_; }

  /// Every command that reads a clip, with `clip` for it.
  static std::vector<Words> with_clip(const std::string& clip) {
    return {{"pair", "--input", clip, "--output", "@walk.bvh", "-o", "@new"},
            {"pair", "--input", "@walk.bvh", "--output", clip, "-o", "@new"},
            {"translate", "@copy.strut", clip, "-o", "@new"},
            {"align", clip, "@walk.bvh", "--csv", "@new"},
            {"align", "@walk.bvh", clip, "--csv", "@new"},
            {"convert", clip, "-o", "@new"},
            {"measure", clip},
            {"measure", "@walk.bvh", "--against", clip},
            {"info", clip}};
  }
  /// Every command that writes a file, with `output` for it.
  static std::vector<Words> with_output(const std::string& output) {
    return {{"pair", "--input", "@walk.bvh", "--output", "@walk.bvh", "-o", output},
            {"learn", "@pairs.toml", "-o", output},
            {"translate", "@copy.strut", "@walk.bvh", "-o", output},
            {"align", "@walk.bvh", "@walk.bvh", "--csv", output},
            {"convert", "@walk.bvh", "-o", output},
            {"sysid", "@table.csv", "--inputs", "u", "--outputs", "y", "-o", output}};
  }

  Workplace here_;
  Motion walk_ = short_walk(0.0, 2.0);
  std::set<std::string> before_;
};

std::ptrdiff_t num_lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST_F(BadInput, EveryClipThatCannotBeReadEndsInOneLineAndCode3) {
  write_file(here_.file("empty.bvh"), "");
  write_file(here_.file("junk.bvh"), std::string("\x7f\x45\0\xff\n\r", 6));
  std::string text = read_file(here_.file("walk.bvh"));
  text.replace(text.rfind(' ') + 1, 3, "nan");
  write_file(here_.file("nan.bvh"), text);
  before_ = here_.entries();
  for (const char* clip : {"missing.bvh", "empty.bvh", "junk.bvh", "nan.bvh", "copy.strut", "pairs.toml", "."}) {
    for (const Words& command : with_clip("@" + std::string(clip))) {
      if (command.front() == "info" && std::string(clip) == "copy.strut") continue;  // it tells of models too
      const ProgramResult result = run(command);
      EXPECT_EQ(result.exit_code, 3) << command[0] << " " << clip;
      EXPECT_THAT(result.err, StartsWith(here_.file(clip)));
      EXPECT_THAT(result.err, HasSubstr(": error: "));
      EXPECT_EQ(num_lines(result.err), 1) << result.err;
    }
  }
  EXPECT_TRUE(left_nothing());
}

TEST_F(BadInput, EveryOutputThatCannotBeWrittenEndsInCode1) {
  for (const auto& [output, reason] :
       {std::pair("@nowhere/new", "there is no folder"), std::pair("@.", "is a folder, not a file"),
        std::pair("@walk.bvh", "the file already exists"), std::pair("/dev/full", "No space left on device")}) {
    for (const Words& command : with_output(output)) {
      const ProgramResult result = run(command);
      EXPECT_EQ(result.exit_code, 1) << command[0] << " " << output;
      EXPECT_THAT(result.err, HasSubstr(reason));
    }
  }
  EXPECT_TRUE(left_nothing());
}

TEST_F(BadInput, AFullDiskLeavesNothing) {
  // The largest file allowed stands in for the disk: 1 or 2 blocks are less than any output.
  for (const Words& command : with_output("@new")) {
    if (command[0] == "pair") continue;  // a list may be as short as its messages, which go to files here too
    const ProgramResult result = run_after("ulimit -f 2", command);
    EXPECT_EQ(result.exit_code, 1) << command[0] << result.err;
    EXPECT_THAT(result.err, HasSubstr("new: error: cannot write: File too large"));
    EXPECT_TRUE(left_nothing()) << command[0];
  }
}

TEST_F(BadInput, FilesWithoutPermissionAreRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read and write everything";
  ASSERT_EQ(::chmod(here_.file("walk.bvh").c_str(), 0), 0);
  for (const Words& command : with_clip("@walk.bvh")) EXPECT_EQ(run(command).exit_code, 3) << command[0];
}

TEST_F(BadInput, ResultsThatCannotBePrintedEndInCode1) {
  for (const Words& command : {Words{"info", "@walk.bvh", "--json"}, Words{"measure", "@walk.bvh"}, Words{"--help"}}) {
    for (const char* output : {"exec >/dev/full", "exec >&-"}) {
      const ProgramResult result = run_after(output, command);
      EXPECT_EQ(result.exit_code, 1) << command[0] << output;
      EXPECT_THAT(result.err, HasSubstr("strut: error: cannot write to standard output\n"));
    }
  }
}

TEST_F(BadInput, MessagesThatCannotBePrintedDoNoHarm) {
  for (const char* output : {"exec 2>/dev/full", "exec 2>&-", "exec <&- 2>&-"}) {
    EXPECT_EQ(run_after(output, {"translate", "@copy.strut", "@walk.bvh", "-o", "@new", "--force"}).exit_code, 0);
    EXPECT_NO_THROW(read_bvh(here_.file("new"))) << "messages must not go into the file";
    EXPECT_EQ(run_after(output, {"info", "@missing.bvh"}).exit_code, 3);
    EXPECT_EQ(run_after(output, {"info", "--unknown"}).exit_code, 2);
  }
}

TEST_F(BadInput, WrongUsageIsToldInPlainWords) {
  const std::vector<std::pair<Words, std::string>> wrong = {
      {{}, "strut: error: a command is missing\nhint: strut --help tells more\n"},
      {{"lern"}, "strut: error: there is no command 'lern'\nhint: did you mean 'learn'? strut --help tells more\n"},
      {{"learn"}, "strut learn: error: pairs is missing: "},
      {{"learn", "x.toml"}, "strut learn: error: --output is missing: "},
      {{"learn", "x.toml", "-o"}, "strut learn: error: --output: its value is missing\n"},
      {{"learn", "x.toml", "-o", "a", "-o", "b"}, "strut learn: error: --output: given more than once\n"},
      {{"learn", "x.toml", "-o", "a", "b"}, "strut learn: error: one argument too many: 'b'\n"},
      {{"learn", "x.toml", "--outptu", "a"},
       "strut learn: error: there is no option '--outptu'\nhint: did you mean '--output'?"},
      {{"learn", "x.toml", "-o", "a", "--max-order", "99"},
       "strut learn: error: --max-order: expected a number from 0 to 20, got '99'\n"},
      {{"learn", "x.toml", "-o", "a", "--max-order", "1.5"},
       "strut learn: error: --max-order: expected a whole number in range, got '1.5'\n"},
      {{"learn", "x.toml", "-o", "a", "--weighting", "none"},
       "strut learn: error: --weighting: expected cva|moesp|n4sid, got 'none'\n"},
      {{"learn", "x.toml", "-o", "a", "--method", "quick"},
       "strut learn: error: --method: expected linear|paper|radial, got 'quick'\n"},
      {{"learn", "x.toml", "-o", "a", "--context", "-1"},
       "strut learn: error: --context: expected a number from 0 to 100, got '-1'\n"},
      {{"learn", "x.toml", "-o", "a", "--centres", "0"},
       "strut learn: error: --centres: expected a number from 1 to 5000, got '0'\n"},
      {{"learn", "x.toml", "-o", "a", "--width", "0"},
       "strut learn: error: --width: expected a number from 0.01 to 100, got '0'\n"},
      {{"learn", "x.toml", "-o", "a", "--shrinkage", "none"},
       "strut learn: error: --shrinkage: expected a number from 1e-09 to 1e+06, got 'none'\n"},
      {{"align", "a", "b", "--smoothness", "nan"},
       "strut align: error: --smoothness: expected a number from 0 to 1e+12, got 'nan'\n"},
      {{"convert", "a", "-o", "b", "--keep-layout", "--rotation-order", "xyz"},
       "strut convert: error: --keep-layout cannot go together with --rotation-order\n"}};
  for (const auto& [arguments, message] : wrong) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.err, StartsWith(message));
    EXPECT_EQ(result.out, "");
  }
}

TEST_F(BadInput, EveryCommandHasHelp) {
  for (const char* command :
       {"pair", "learn", "translate", "align", "info", "convert", "measure", "sysid", "demo", "completion"}) {
    const ProgramResult result = run({command, "--help"});
    EXPECT_EQ(result.exit_code, 0) << command;
    EXPECT_THAT(result.out, HasSubstr("strut " + std::string(command)));
    EXPECT_THAT(result.out, Not(HasSubstr("->"))) << "a parser's own notation";
    EXPECT_EQ(result.err, "");
  }
}

/// Runs `command`, sends `signal` after `delay`, waits for the end.
void run_and_interrupt(const Words& command, int signal, std::chrono::milliseconds delay) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    ::execv(STRUT_PROGRAM, arguments.data());
    ::_exit(127);
  }
  std::this_thread::sleep_for(delay);
  ::kill(child, signal);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) != 0) << WEXITSTATUS(status);
}

TEST_F(BadInput, AnInterruptedRunLeavesAWholeFileOrNone) {
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    for (const int delay : {1, 10, 30, 100}) {
      run_and_interrupt({"strut", "learn", here_.file("pairs.toml"), "-o", here_.file("new.strut"), "--force"}, signal,
                        std::chrono::milliseconds(delay));
      std::set<std::string> left = here_.entries();
      if (left.erase("new.strut") == 1) {
        EXPECT_NO_THROW(read_style_model(here_.file("new.strut")));
      }
      EXPECT_EQ(left, before_);
    }
  }
}

}  // namespace
}  // namespace strut::test
