// SPDX-License-Identifier: MIT
#include "support/program.h"

#include <cstdlib>
#include <filesystem>
#include <sys/wait.h>

#include <strut/core/file.h>

namespace strut::test {
namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  std::string command = quoted(program);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  command += " </dev/null >" + quoted(folder.file("out")) + " 2>" + quoted(folder.file("err"));
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c): the shell only redirects
  ProgramResult result;
  if (status != -1) result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_file(folder.file("out"));
  result.err = read_file(folder.file("err"));
  return result;
}

ProgramResult Workplace::run(const std::string& program, std::vector<std::string> arguments) const {
  for (std::string& argument : arguments) {
    if (argument[0] == '@') argument = file(argument.substr(1));
  }
  return run_program(program, arguments);
}

std::set<std::string> Workplace::entries() const {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

}  // namespace strut::test
