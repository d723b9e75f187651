// SPDX-License-Identifier: MIT
// Runs a program as a person at a terminal would and keeps what it said.
#pragma once

#include "support/data.h"

#include <set>
#include <string>
#include <vector>

namespace strut::test {

/// What a finished program left.
struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal if it was killed
  std::string out;     ///< standard output
  std::string err;     ///< standard error
};

/// Runs `program` with `arguments` (passed on unchanged, spaces and all) and empty standard input; waits for its end.
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments);

/// A folder with inputs, in which the program runs: what it leaves there is the question.
class Workplace {
 public:
  /// Runs the strut program `program`; arguments that begin with '@' are files of this folder.
  ProgramResult run(const std::string& program, std::vector<std::string> arguments) const;
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  /// Names of all that is in the folder, hidden or not.
  [[nodiscard]] std::set<std::string> entries() const;

 private:
  TemporaryFolder folder_;
};

}  // namespace strut::test
