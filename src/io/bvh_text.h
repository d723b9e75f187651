// SPDX-License-Identifier: MIT
// A cursor over the text of a BVH file: words, numbers, and errors that know their line and column. Lines are counted
// only when a message needs them, so the cursor costs nothing on the way.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <strut/core/error.h>

namespace strut::io::detail {

/// Larger numbers are not motion; refusing them keeps every later sum and product finite.
inline constexpr double kLargestNumber = 1e12;

class BvhCursor {
 public:
  /// Starts behind a byte-order mark. Both strings must outlive the cursor.
  BvhCursor(std::string_view text, const std::string& name);

  [[nodiscard]] std::size_t position() const { return position_; }
  void set_position(std::size_t position) { position_ = position; }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] bool at_end() const { return position_ == text_.size(); }
  [[nodiscard]] bool at_line_end() const { return at_end() || text_[position_] == '\n'; }

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
  std::string_view text_;
  const std::string& name_;
  std::size_t position_ = 0;
};

}  // namespace strut::io::detail
