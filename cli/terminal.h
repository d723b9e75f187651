// SPDX-License-Identifier: MIT
// What the commands share in talking to a person: reports of diagnostics, a progress line, exit codes.
// Results go to standard output; diagnostics, progress and errors to standard error.
#pragma once

#include <chrono>
#include <string>

#include <strut/core/diagnostics.h>
#include <strut/core/file.h>

namespace strut::cli {

/// Exit codes of the program.
enum ExitCode {
  kDone = 0,
  kFailed = 1,
  kUsage = 2,
  kBadInput = 3,
  kMismatch = 4,
};

/// Writes to standard error. What cannot be written there (closed, disk full) is nobody's to know.
void say(const std::string& text);

/// Prints each report as `where: note: message` or `where: warning: message`, then its hint. Repeats are printed once,
/// and the same message about several files as one about `FIRST and 7 others`.
void print_diagnostics(const Diagnostics& diagnostics);

/// A sink that prints what it has got when it goes: all of it, or only the warnings where an error ends the command, as
/// what was assumed about a file no longer matters then.
class PrintedDiagnostics : public Diagnostics {
 public:
  PrintedDiagnostics() = default;
  PrintedDiagnostics(const PrintedDiagnostics&) = delete;
  PrintedDiagnostics& operator=(const PrintedDiagnostics&) = delete;
  ~PrintedDiagnostics();
};

/// kAllow with --force, else kRefuse.
inline Overwrite overwrite_if(bool force) {
  return force ? Overwrite::kAllow : Overwrite::kRefuse;
}

/// One line on standard error that is rewritten in place while something long runs, and gone when it ends. Silent where
/// standard error is not a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(std::string label);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();
  /// Shows `step` with `done` of `total`. Redraws at most twenty times a second.
  void update(const std::string& step, int done, int total);

 private:
  std::string label_;
  bool is_terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace strut::cli
