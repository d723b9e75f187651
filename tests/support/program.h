// SPDX-License-Identifier: MIT
// Runs a program as a person at a terminal would and keeps what it said.
#pragma once

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

}  // namespace strut::test
