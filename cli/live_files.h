// SPDX-License-Identifier: MIT
// Bytes in as they come and rows out at once, for commands that run while motion is being recorded: pipes, files that
// grow, and the ways such a run ends without harm: an interrupt, a reader that goes away.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <strut/core/file.h>

namespace strut::cli {

/// Thrown out of a wait for input or output when SIGINT or SIGTERM has come. No error.
class Interrupted {};

/// Thrown where output is no longer wanted: whoever read the pipe has closed it. No error.
class OutputClosed {};

/// While it lives, SIGINT and SIGTERM end waits instead of the program (a second one ends the program), and a closed
/// pipe is told by writing to it. One at a time.
class InterruptSignals {
 public:
  InterruptSignals();
  InterruptSignals(const InterruptSignals&) = delete;
  InterruptSignals& operator=(const InterruptSignals&) = delete;
  ~InterruptSignals();

  /// Waits until `fd` can be read or written (`events` of poll), for at most `milliseconds` if that is not negative.
  /// `fd` -1: just waits. Throws Interrupted.
  void wait(int fd, short events, int milliseconds) const;
};

/// Bytes of standard input or a file.
class LiveInput {
 public:
  /// When a file that grows has ended.
  struct Following {
    std::optional<double> idle;         ///< it has not grown for so long [s]
    std::function<bool()> is_complete;  ///< asked whenever all that is there was read
  };

  /// `path` "-": standard input. `signals` must outlive this. Throws FileError.
  LiveInput(const std::string& path, const InterruptSignals& signals);
  LiveInput(const LiveInput&) = delete;
  LiveInput& operator=(const LiveInput&) = delete;
  ~LiveInput();

  /// From now on the end of the file is not the end.
  void follow(Following following) { following_ = std::move(following); }

  /// As ReadBytes: waits for bytes; 0 at the end. Throws FileError, Interrupted.
  std::size_t read(char* to, std::size_t size);

 private:
  std::size_t read_some(char* to, std::size_t size);
  void check_not_cut();

  std::string path_;
  const InterruptSignals& signals_;
  int fd_;
  std::size_t num_read_ = 0;
  std::optional<Following> following_;
};

/// Rows to standard output or a file, each written before the next is asked for.
class LiveOutput {
 public:
  /// `path` "-": standard output. A file is made or, if `overwrite` allows it, emptied. Throws FileError.
  LiveOutput(const std::string& path, Overwrite overwrite, const InterruptSignals& signals);
  LiveOutput(const LiveOutput&) = delete;
  LiveOutput& operator=(const LiveOutput&) = delete;
  ~LiveOutput();

  /// All of `text`; an interrupt that comes before its first byte is thrown, one that comes later waits for its last.
  /// Throws FileError, Interrupted, OutputClosed.
  void write(std::string_view text);

 private:
  std::string path_;
  const InterruptSignals& signals_;
  int fd_;
};

}  // namespace strut::cli
