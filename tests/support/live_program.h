// SPDX-License-Identifier: MIT
// A program that is talked to while it runs: its input is written and its output read piece by piece.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace strut::test {

class LiveProgram {
 public:
  LiveProgram(const std::string& program, const std::vector<std::string>& arguments);
  LiveProgram(const LiveProgram&) = delete;
  LiveProgram& operator=(const LiveProgram&) = delete;
  ~LiveProgram();

  void write(const std::string& text);
  /// As much of it as the program takes before it closes its input or ends.
  void write_what_is_taken(const std::string& text);
  void close_input();
  /// The next line of its standard output, with its end; what there is if the output ends; "(silence)" if nothing
  /// comes for ten seconds.
  std::string read_line();
  /// Whether nothing more has come, without waiting for long.
  [[nodiscard]] bool is_silent();
  void close_output();
  void send(int signal) const;
  /// Waits for its end; 128 + signal if it was killed.
  int exit_code();
  /// The most memory it held [bytes]; after exit_code().
  [[nodiscard]] long peak_memory() const { return peak_memory_; }
  /// What it said on standard error; after exit_code().
  [[nodiscard]] std::string err();

 private:
  pid_t process_ = -1;
  int input_ = -1, output_ = -1, error_ = -1;
  std::string read_;
  long peak_memory_ = 0;
};

}  // namespace strut::test
