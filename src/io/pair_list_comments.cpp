// SPDX-License-Identifier: MIT
// A '#' begins a comment wherever no string is open, so strings are all that has to be understood of TOML here.
#include "io/pair_list_comments.h"

#include <algorithm>

namespace strut::io::detail {
namespace {

struct Comment {
  std::size_t line = 0;
  bool stands_alone = false;  ///< nothing but blanks before it in its line
  std::string text;
};

/// Where the string that begins at `at` is over.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool is_long = text.substr(at, 3) == three;
  for (at += is_long ? 3 : 1; at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"') {
      ++at;
    } else if (is_long && text.substr(at, 3) == three) {
      at += 3;
      while (at < text.size() && text[at] == quote) ++at;  // quotes that belong to the string
      return at;
    } else if (!is_long && text[at] == quote) {
      return at + 1;
    }
  }
  return text.size();
}

/// A comment from its '#' to the end of its line, as it is read: without '#', the blank after it and blanks at the end.
std::string words_of(std::string_view comment) {
  comment.remove_prefix(1);
  std::string words(comment);
  std::replace(words.begin(), words.end(), '\t', ' ');  // as it is written again
  if (!words.empty() && words.front() == ' ') words.erase(0, 1);
  words.erase(words.find_last_not_of(" \r") + 1);
  return words;
}

std::vector<Comment> find_comments(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::vector<Comment> found;
  std::size_t line = 1, line_begin = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (std::size_t at = line_begin; at < text.size();) {
    if (text[at] == '#') {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const bool stands_alone =
          text.substr(line_begin, at - line_begin).find_first_not_of(" \t") == std::string_view::npos;
      found.push_back({line, stands_alone, words_of(text.substr(at, end - at))});
      at = end;
      continue;
    }
    const std::size_t next = text[at] == '"' || text[at] == '\'' ? end_of_string(text, at) : at + 1;
    for (; at < next; ++at) {
      if (text[at] != '\n') continue;
      ++line;
      line_begin = at + 1;
    }
  }
  return found;
}

/// The comments [begin, end), blank lines between them kept, none at the ends.
std::string joined(const std::vector<Comment>& comments, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < end; ++i) {
    if (i > begin) text += comments[i].line > comments[i - 1].line + 1 ? "\n\n" : "\n";
    text += comments[i].text;
  }
  text.erase(text.find_last_not_of('\n') + 1);
  return text.erase(0, text.find_first_not_of('\n'));
}

std::string together(std::string above, const std::string& below) {
  if (above.empty() || below.empty()) return above + below;
  return std::move(above) + "\n" + below;
}

/// How many of the comments above the first pair, at `first_line`, a blank line parts from it.
std::size_t size_of_heading(const std::vector<Comment>& above, std::size_t first_line) {
  std::size_t count = above.size(), line = first_line;
  while (count > 0 && above[count - 1].line + 1 >= line) line = above[--count].line;
  return count;
}

}  // namespace

PairListComments comments_of(std::string_view text, const std::vector<LineSpan>& pairs) {
  const std::size_t num_pairs = pairs.size();
  std::vector<std::vector<Comment>> above(num_pairs + 1), inside(num_pairs);
  std::size_t next = 0;  // the first pair that begins further down
  for (Comment& comment : find_comments(text)) {
    while (next < num_pairs && pairs[next].first <= comment.line) ++next;
    const bool is_inside = next > 0 && (!comment.stands_alone || comment.line <= pairs[next - 1].last);
    (is_inside ? inside[next - 1] : above[next]).push_back(std::move(comment));
  }
  PairListComments placed;
  const std::size_t heading = num_pairs > 0 ? size_of_heading(above[0], pairs[0].first) : 0;
  placed.heading = joined(above[0], 0, heading);
  for (std::size_t i = 0; i < num_pairs; ++i) {
    placed.of_pairs.push_back(
        together(joined(above[i], i == 0 ? heading : 0, above[i].size()), joined(inside[i], 0, inside[i].size())));
  }
  placed.ending = joined(above[num_pairs], 0, above[num_pairs].size());
  return placed;
}

}  // namespace strut::io::detail
