// SPDX-License-Identifier: MIT
#include "bvh_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace strut::io::detail {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
constexpr std::size_t kLongestQuote = 32;
constexpr std::size_t kLookedAt = 64;  // bytes at the beginning, in which no text has a zero

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

bool is_space(char c) {
  return is_blank(c) || c == '\n';
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return lower(x) == lower(y); });
}

bool is_continuation_byte(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// `word` in quotes, shortened, with bytes that would upset a terminal written as \xNN.
std::string quoted(std::string_view word) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text = "'";
  for (const char c : word.substr(0, kLongestQuote)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      text += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
    } else {
      text += c;
    }
  }
  return text + (word.size() > kLongestQuote ? "...'" : "'");
}

}  // namespace

BvhCursor::BvhCursor(std::string_view text, const std::string& name) : text_(text), name_(name) {
  check_encoding();
}

BvhCursor::BvhCursor(BvhLines& lines, const std::string& name) : lines_(&lines), name_(name) {
  append_line();
  check_encoding();
}

void BvhCursor::check_encoding() {
  if (text_.substr(0, 2) == "\xFF\xFE" || text_.substr(0, 2) == "\xFE\xFF") {
    fail_with(0, "text in ASCII or UTF-8", "UTF-16", "save the file as plain text");
  }
  if (text_.substr(0, kLookedAt).find('\0') != text_.npos) {
    fail_with(0, "a BVH file, which is text", "a binary file, as models are");
  }
  if (text_.substr(0, kUtf8Mark.size()) == kUtf8Mark) position_ = kUtf8Mark.size();
}

bool BvhCursor::append_line() {
  if (lines_ == nullptr || !lines_->append_line(kept_)) return false;
  text_ = kept_;
  return true;
}

void BvhCursor::forget_lines() {
  if (lines_ == nullptr || position_ == 0) return;
  const std::size_t line_begin = text_.rfind('\n', position_ - 1) + 1;  // npos + 1 is 0
  forgotten_ += line_at(line_begin) - line_at(0);
  kept_.erase(0, line_begin);
  text_ = kept_;
  position_ -= line_begin;
}

std::size_t BvhCursor::line_at(std::size_t position) const {
  const std::string_view before = text_.substr(0, position);
  return forgotten_ + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
}

void BvhCursor::skip_blanks() {
  while (!at_end() && is_blank(text_[position_])) ++position_;
}

void BvhCursor::skip_space() {
  while (!at_end() && is_space(text_[position_])) ++position_;
}

std::string_view BvhCursor::peek_word() {
  skip_space();
  std::size_t end = position_;
  while (end < text_.size() && !is_space(text_[end]) && text_[end] != '{' && text_[end] != '}' && text_[end] != ':') {
    ++end;
  }
  return text_.substr(position_, end - position_);
}

bool BvhCursor::accept_word(std::string_view keyword) {
  if (!equal_ignoring_case(peek_word(), keyword)) return false;
  position_ += keyword.size();
  return true;
}

void BvhCursor::expect_word(std::string_view keyword) {
  if (!accept_word(keyword)) fail(position_, quoted(keyword));
}

void BvhCursor::expect_mark(char mark) {
  skip_space();
  if (at_end() || text_[position_] != mark) fail(position_, quoted({&mark, 1}));
  ++position_;
}

std::string_view BvhCursor::rest_of_line() {
  skip_blanks();
  const std::size_t begin = position_;
  position_ = std::min(text_.find_first_of("{\n", begin), text_.size());
  std::size_t end = position_;
  while (end > begin && is_blank(text_[end - 1])) --end;
  return text_.substr(begin, end - begin);
}

double BvhCursor::expect_number() {
  skip_blanks();
  return number_or_fail(position_);
}

long long BvhCursor::expect_count(const std::string& what, long long largest) {
  skip_blanks();
  long long value = -1;
  const char* begin = text_.data() + position_;
  const char* last = text_.data() + text_.size();
  const auto [end, error] = std::from_chars(begin, last, value);
  const bool is_whole = end == last || is_space(*end) || *end == '{' || *end == '}';
  if (error != std::errc() || !is_whole || value < 0 || value > largest) {
    fail(position_, what + " from 0 to " + std::to_string(largest));
  }
  position_ += static_cast<std::size_t>(end - begin);
  return value;
}

double BvhCursor::number_or_fail(std::size_t& position) const {
  const char* begin = text_.data() + position;
  const char* last = text_.data() + text_.size();
  const char* digits = begin + (begin + 1 < last && *begin == '+' && begin[1] != '-' ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits, last, value);
  const bool is_whole = end == last || is_space(*end) || *end == '{' || *end == '}';
  const std::string_view token(begin, static_cast<std::size_t>(end - begin));
  if (error == std::errc::invalid_argument || !is_whole) {
    const bool has_comma = end != last && *end == ',' && end != begin;
    fail(position, "a number", has_comma ? "write a decimal point, and blanks between numbers" : "");
  }
  const bool is_tiny =
      error == std::errc::result_out_of_range && (token.find("e-") != token.npos || token.find("E-") != token.npos);
  if (is_tiny) value = 0.0;
  if (!is_tiny && (error != std::errc() || !(std::abs(value) <= kLargestNumber))) {
    fail(position, std::isfinite(value) && error == std::errc() ? "a number of at most 1e12" : "a finite number");
  }
  position += token.size();
  return value;
}

void BvhCursor::fail(std::size_t position, const std::string& expected, const std::string& hint) const {
  fail_with(position, expected, describe(position), hint);
}

void BvhCursor::fail_with(std::size_t position, const std::string& expected, const std::string& found,
                          const std::string& hint) const {
  const std::string_view before = text_.substr(0, position);
  const std::size_t line = line_at(position);
  const std::size_t line_begin = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
  std::string_view on_line = before.substr(line_begin);
  if (line == 1 && on_line.substr(0, kUtf8Mark.size()) == kUtf8Mark) on_line.remove_prefix(kUtf8Mark.size());
  const auto inside = std::count_if(on_line.begin(), on_line.end(), is_continuation_byte);
  throw ParseError(name_, line, on_line.size() - static_cast<std::size_t>(inside) + 1, expected, found, hint);
}

std::string BvhCursor::describe(std::size_t position) const {
  if (position >= text_.size()) return "end of file";
  const char c = text_[position];
  if (c == '\n' || c == '\r') return "end of line";
  if (c == '\0') return "a zero byte";
  std::size_t end = position + 1;
  while (end < text_.size() && !is_space(text_[end]) && text_[end] != '{' && text_[end] != '}') ++end;
  return quoted(text_.substr(position, end - position));
}

std::string BvhCursor::line_label(std::size_t position) const {
  return name_ + ":" + std::to_string(line_at(position));
}

}  // namespace strut::io::detail
