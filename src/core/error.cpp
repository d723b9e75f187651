// SPDX-License-Identifier: MIT
// Builds the messages of the exceptions in strut/core/error.h.
#include <sstream>
#include <utility>

#include <strut/core/error.h>

namespace strut {
namespace {

std::string place(const std::string& path, std::size_t line, std::size_t column) {
  std::string text = path;
  if (line > 0) text += ":" + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  return text;
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

ParseError::ParseError(std::string path, std::size_t line, std::size_t column, std::string expected, std::string found,
                       std::string hint)
    : Error(place(path, line, column) + ": error: expected " + expected + ", found " + found, std::move(hint)),
      path_(std::move(path)),
      expected_(std::move(expected)),
      found_(std::move(found)),
      line_(line),
      column_(column) {}

FileError::FileError(FileAction action, std::string path, std::string reason, std::string hint)
    : Error(path + ": error: " + reason, std::move(hint)),
      action_(action),
      path_(std::move(path)),
      reason_(std::move(reason)) {}

VersionError::VersionError(const std::string& path, int found, int supported)
    : Error(path + ": error: the file has format version " + std::to_string(found) + ", this strut reads version " +
                std::to_string(supported),
            found > supported ? "use a newer strut" : "learn the model again with this strut") {}

InvalidArgument::InvalidArgument(std::string argument, const std::string& expected, const std::string& got,
                                 std::string hint)
    : Error(argument + ": expected " + expected + ", got " + got, std::move(hint)), argument_(std::move(argument)) {}

InvalidArgument::InvalidArgument(const std::string& where, const InvalidArgument& error)
    : Error(where + ": " + error.what(), error.hint()), argument_(error.argument_) {}

NumericalError::NumericalError(const std::string& stage, const std::string& quantity, double value, double bound)
    : Error(stage + ": " + quantity + " is " + number(value) + ", beyond its bound of " + number(bound)) {}

}  // namespace strut
