// SPDX-License-Identifier: MIT
// Bytes as they come to lines: what a cursor over a stream is fed with.
#pragma once

#include <cstddef>
#include <string>

#include <strut/io/bvh_stream.h>

namespace strut::io::detail {

class BvhLines {
 public:
  /// `name` stands for the source in messages.
  BvhLines(ReadBytes read, std::string name) : read_(std::move(read)), name_(std::move(name)) {}

  /// Appends the next line with its line end (the last one may have none) to `text`; false at the end.
  /// Throws FileError if `text` becomes longer than any header or row is.
  bool append_line(std::string& text);

 private:
  /// False at the end.
  bool refill();
  void append(std::string& text, std::size_t end);

  ReadBytes read_;
  std::string name_;
  std::string bytes_;  // read and not yet given: from begin_ on
  std::size_t begin_ = 0;
  bool at_end_ = false;
};

}  // namespace strut::io::detail
