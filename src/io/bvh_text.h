// SPDX-License-Identifier: MIT
// A cursor over the text of a BVH file, whole or as it comes: words, numbers, and errors that know their line and
// column. Lines are counted only when a message needs them, so the cursor costs nothing on the way.
#pragma once

#include "bvh_lines.h"

#include <cstddef>
#include <string>
#include <string_view>

#include <strut/core/error.h>

namespace strut::io::detail {

/// Larger numbers are not motion; refusing them keeps every later sum and product finite.
inline constexpr double kLargestNumber = 1e12;

class BvhCursor {
 public:
  /// Starts behind a byte-order mark. What is given must outlive the cursor.
  BvhCursor(std::string_view text, const std::string& name);
  /// The same over lines that come one by one: text() is what has come so far and was not forgotten; it grows, and
  /// moves, wherever the cursor reaches its end.
  BvhCursor(BvhLines& lines, const std::string& name);
  BvhCursor(const BvhCursor&) = delete;
  BvhCursor& operator=(const BvhCursor&) = delete;

  [[nodiscard]] std::size_t position() const { return position_; }
  void set_position(std::size_t position) { position_ = position; }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] bool at_end() { return position_ == text_.size() && !append_line(); }
  [[nodiscard]] bool at_line_end() { return at_end() || text_[position_] == '\n'; }
  /// Lets go of the lines before this one where text comes line by line: positions count from here afterwards.
  void forget_lines();

  /// Over spaces, tabs and carriage returns, but not to another line.
  void skip_blanks();
  /// Over blanks and line ends.
  void skip_space();

  /// The word (up to white space, brace or colon) after white space, without moving past it.
  std::string_view peek_word();
  /// Whether the next word is `keyword` in any case; moves past it if so.
  bool accept_word(std::string_view keyword);
  /// Like accept_word, but throws ParseError if the word is another.
  void expect_word(std::string_view keyword);
  /// Moves past the character `mark`, or throws ParseError.
  void expect_mark(char mark);
  /// The rest of the line, or what precedes a brace on it, without blanks around it.
  std::string_view rest_of_line();
  /// A finite number on this line, or ParseError.
  double expect_number();
  /// A whole number from 0 to `largest`, or ParseError that calls it `what`.
  long long expect_count(const std::string& what, long long largest);

  /// Throws ParseError for the text at `position`.
  [[noreturn]] void fail(std::size_t position, const std::string& expected, const std::string& hint = {}) const;
  /// Throws ParseError with a description of what was found.
  [[noreturn]] void fail_with(std::size_t position, const std::string& expected, const std::string& found,
                              const std::string& hint = {}) const;
  /// Why the text at `position` is no number: throws ParseError; or returns its value if it is one after all (a plus
  /// sign in front, too small for a double) and moves `position` behind it.
  double number_or_fail(std::size_t& position) const;
  /// What stands at `position`, for a message: "'word'", "end of line", "end of file".
  [[nodiscard]] std::string describe(std::size_t position) const;
  /// `name:line`, for a diagnostic.
  [[nodiscard]] std::string line_label(std::size_t position) const;

 private:
  void check_encoding();
  bool append_line();
  /// Of the text at `position`, from 1.
  [[nodiscard]] std::size_t line_at(std::size_t position) const;

  BvhLines* lines_ = nullptr;
  std::string kept_;  // lines that have come
  std::string_view text_;
  const std::string& name_;
  std::size_t position_ = 0;
  std::size_t forgotten_ = 0;  // lines before text_
};

}  // namespace strut::io::detail
