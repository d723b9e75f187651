// SPDX-License-Identifier: MIT
// The one family of exceptions strut throws. Every message is written for the person at the terminal: what went wrong,
// where, what was expected, and (in hint()) what to do about it. The library never prints and never aborts.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace strut {

/// Base of everything strut throws. what() is one line without a final newline.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, std::string hint = {})
      : std::runtime_error(message), hint_(std::move(hint)) {}
  /// What the person can do about it; empty if there is nothing to say beyond what().
  [[nodiscard]] const std::string& hint() const noexcept { return hint_; }

 private:
  std::string hint_;
};

/// A file's text is not what its format asks for. what() reads `walk.bvh:214:7: error: expected a number, found 'abc'`.
class ParseError : public Error {
 public:
  /// `line` and `column` count from 1; 0 means "not known" and is left out of the message.
  ParseError(std::string path, std::size_t line, std::size_t column, std::string expected, std::string found,
             std::string hint = {});
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  [[nodiscard]] std::size_t column() const noexcept { return column_; }
  [[nodiscard]] const std::string& expected() const noexcept { return expected_; }
  [[nodiscard]] const std::string& found() const noexcept { return found_; }

 private:
  std::string path_, expected_, found_;
  std::size_t line_, column_;
};

/// What was being done with a file when it failed.
enum class FileAction { kRead, kWrite };

/// A file cannot be opened, read or written: what() names the path and the system's reason.
class FileError : public Error {
 public:
  FileError(FileAction action, std::string path, std::string reason, std::string hint = {});
  [[nodiscard]] FileAction action() const noexcept { return action_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

 private:
  FileAction action_;
  std::string path_, reason_;
};

/// A file was written by a version of strut whose format this one does not read.
class VersionError : public Error {
 public:
  VersionError(const std::string& path, int found, int supported);
};

/// A caller's argument is outside what the function accepts: which argument, what was expected, what came.
class InvalidArgument : public Error {
 public:
  InvalidArgument(std::string argument, const std::string& expected, const std::string& got, std::string hint = {});
  /// The same error about one of several: what() begins with `where`, e.g. "clip 3".
  InvalidArgument(const std::string& where, const InvalidArgument& error);
  [[nodiscard]] const std::string& argument() const noexcept { return argument_; }

 private:
  std::string argument_;
};

/// A motion's skeleton is not the one a model was learnt on; what() names the joints that do not fit.
class SkeletonMismatch : public Error {
 public:
  using Error::Error;
};

/// A computation left the range in which its result means anything.
class NumericalError : public Error {
 public:
  NumericalError(const std::string& stage, const std::string& quantity, double value, double bound);
};

}  // namespace strut
