// SPDX-License-Identifier: MIT
// What the program says of itself: help, version, completions and the manual page, held against each other.
#include "support/data.h"
#include "support/program.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/core/version.h>

namespace strut::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// What `strut COMMAND --help` says; the command may be of two words.
std::string help_of(const std::string& command) {
  std::istringstream words(command);
  std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
  arguments.emplace_back("--help");
  const ProgramResult result = run_program(STRUT_PROGRAM, arguments);
  EXPECT_EQ(result.exit_code, 0) << command;
  return result.out;
}

std::set<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::set<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.insert(line);
  return lines;
}

/// The commands that `strut COMMAND --help` lists, each with the command's name before it.
std::set<std::string> commands_below(const std::string& command) {
  const std::string help = help_of(command);
  const auto start = help.find("Subcommands:");
  if (start == std::string::npos) return {};
  std::set<std::string> names;
  static const std::regex kRow(R"(\n  ([a-z]+) +\S)");
  const std::string list = help.substr(start, help.find("\n\n", start) - start);
  const std::string before = command.empty() ? "" : command + " ";
  for (std::sregex_iterator row(list.begin(), list.end(), kRow), end; row != end; ++row) {
    names.insert(before + (*row)[1].str());
  }
  return names;
}

/// All commands, with those below another one.
std::set<std::string> commands() {
  std::set<std::string> names = commands_below("");
  for (const std::string& name : commands_below("")) names.merge(commands_below(name));
  return names;
}

/// The options a command's help lists in their long spelling.
std::set<std::string> options_of(const std::string& command) {
  const std::string help = help_of(command);
  std::set<std::string> names;
  static const std::regex kRow(R"(\n  (?:-\w,)?(--[a-z-]+))");
  for (std::sregex_iterator row(help.begin(), help.end(), kRow), end; row != end; ++row) names.insert((*row)[1]);
  return names;
}

/// What bash offers for the words typed so far, the last of which is being completed.
std::set<std::string> completions(const std::string& words) {
  const std::string script = "eval \"$('" STRUT_PROGRAM "' completion bash)\"; COMP_WORDS=(" + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _strut; printf '%s\\n' \"${COMPREPLY[@]}\"";
  const ProgramResult result = run_program("/bin/bash", {"-c", script});
  EXPECT_EQ(result.err, "");
  return lines_of(result.out);
}

TEST(Program, ListsItsCommands) {
  EXPECT_THAT(commands(),
              testing::IsSupersetOf({"pair", "learn", "translate", "clean", "align", "info", "convert", "measure",
                                     "footplants", "sysid", "blend", "effort", "report", "demo", "completion"}));
}

TEST(Program, DescribesEveryCommandAndOption) {
  static const std::regex kBare(R"(\n  (-\S+)( \S+){0,2}\n(?=  -|\n))");
  for (const std::string& command : commands()) {
    const std::string help = help_of(command);
    EXPECT_THAT(options_of(command), Contains("--help"));
    EXPECT_FALSE(help.empty() || help.front() == '\n' || help.starts_with("Usage")) << command << " says nothing";
    std::smatch bare;
    EXPECT_FALSE(std::regex_search(help, bare, kBare)) << command << " does not say what " << bare[1] << " is";
  }
}

TEST(Program, TellsItsVersion) {
  const ProgramResult result = run_program(STRUT_PROGRAM, {"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, std::string("strut ") + version() + "\n");
}

TEST(Program, AnswersWrongUsageWithTwo) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {}, {"no-such-command"}, {"learn", "--no-such"}, {"effort"}, {"effort", "no-such"}}) {
    const ProgramResult result = run_program(STRUT_PROGRAM, arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err, "");
  }
}

TEST(Program, SaysWhenItsOutputCannotBeWritten) {
  const ProgramResult result = run_program("/bin/sh", {"-c", "'" STRUT_PROGRAM "' completion bash > /dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "strut: error: cannot write to standard output\n");
}

TEST(BashCompletion, OffersEveryCommandAndOption) {
  for (const std::string& command : commands()) {
    const auto space = command.find(' ');
    const std::string before = space == std::string::npos ? "" : command.substr(0, space + 1);
    EXPECT_THAT(completions("strut " + before + "''"), Contains(command.substr(before.size())));
    const auto offered = completions("strut " + command + " --");
    for (const std::string& option : options_of(command)) EXPECT_THAT(offered, Contains(option)) << command;
  }
}

TEST(BashCompletion, NarrowsToWhatIsTyped) {
  EXPECT_EQ(completions("strut tra"), std::set<std::string>{"translate"});
  EXPECT_EQ(completions("strut translate --no-r"), std::set<std::string>{"--no-retime"});
}

TEST(BashCompletion, OffersFixedValues) {
  EXPECT_THAT(completions("strut completion ''"), testing::IsSupersetOf({"bash", "zsh"}));
  EXPECT_EQ(completions("strut align --method i"), std::set<std::string>{"imw"});
  EXPECT_EQ(completions("strut learn --weighting c"), std::set<std::string>{"cva"});
}

TEST(BashCompletion, OffersFilesForAnOptionsValueAndNotOptions) {
  const TemporaryFolder folder;
  write_file(folder.file("clip.bvh"), "");
  const auto offered = completions("strut learn --output " + folder.path() + "/cl");
  EXPECT_EQ(offered, std::set<std::string>{folder.file("clip.bvh")});
  EXPECT_THAT(completions("strut learn --output --fo"), testing::Not(Contains("--force")));
}

TEST(ZshCompletion, ParsesAndHoldsEveryOption) {
  const TemporaryFolder folder;
  const std::string script = run_program(STRUT_PROGRAM, {"completion", "zsh"}).out;
  for (const std::string& command : commands()) {
    for (const std::string& option : options_of(command)) EXPECT_THAT(script, HasSubstr("'*" + option + "["));
  }
  write_file(folder.file("_strut"), script);
  if (::access("/bin/zsh", X_OK) != 0) GTEST_SKIP() << "zsh is not installed: its parser was not asked";
  const ProgramResult result = run_program("/bin/zsh", {"-n", folder.file("_strut")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
}

TEST(ManualPage, TellsOfEveryCommandAndOption) {
  std::string page = read_file(test_file("../docs/strut.1"));
  page.erase(std::remove(page.begin(), page.end(), '\\'), page.end());  // roff writes - as \-
  for (const std::string& command : commands()) {
    const auto start = page.find("\n.SS strut " + command);
    ASSERT_NE(start, std::string::npos) << command;
    const std::string section = page.substr(start, page.find("\n.S", start + 1) - start);
    for (const std::string& option : options_of(command)) {
      EXPECT_TRUE(option == "--help" || section.find(option) != std::string::npos) << command << " " << option;
    }
  }
}

}  // namespace
}  // namespace strut::test
