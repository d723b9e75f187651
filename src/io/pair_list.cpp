// SPDX-License-Identifier: MIT
// toml++ reads and knows the line of every value; writing is plain text, so that comments stand where a person looks.
#include "io/pair_list_comments.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <regex>
#include <sstream>

// toml++ takes for granted that text is well formed where it is not ("[[=" ends in an assertion, or in what the
// optimizer makes of it where NDEBUG is defined) and finds the fault in its next line: here it takes nothing for
// granted.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) static_cast<void>(0)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <strut/core/error.h>
#include <strut/io/pair_list.h>

namespace strut {
namespace {

namespace fs = std::filesystem;

const char* type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::table:
      return "a table";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

/// Reads one list; `path` is the list's, for messages and as what clips are relative to.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), folder_(fs::path(path).parent_path()) {}

  std::vector<PairListEntry> read(const toml::table& root) const {
    for (const auto& [key, value] : root) {
      if (key.str() != "pair") fail(key.source(), "'[[pair]]'", "'" + std::string(key.str()) + "'");
    }
    const toml::node* pairs = root.get("pair");
    if (pairs == nullptr) throw ParseError(path_, 0, 0, "at least one '[[pair]]'", "none");
    const toml::array* list = pairs->as_array();
    if (list == nullptr) {
      fail(pairs->source(), "'[[pair]]' for every pair", type_name(*pairs), "write double brackets: [[pair]]");
    }
    if (list->empty()) fail(pairs->source(), "at least one '[[pair]]'", "none");
    std::vector<PairListEntry> entries;
    for (const toml::node& node : *list) {
      if (!node.is_table()) fail(node.source(), "a table with 'input' and 'output'", type_name(node));
      entries.push_back(entry(*node.as_table()));
    }
    return entries;
  }

 private:
  PairListEntry entry(const toml::table& table) const {
    for (const auto& [key, value] : table) {
      const std::string_view name = key.str();
      if (name == "input" || name == "output" || name == "input_frames" || name == "output_frames") continue;
      fail(key.source(), "'input', 'output', 'input_frames' or 'output_frames'", "'" + std::string(name) + "'");
    }
    return {clip(table, "input"), clip(table, "output"), {}};
  }

  PairedClip clip(const toml::table& table, const std::string& side) const {
    const toml::node* path = table.get(side);
    if (path == nullptr) fail(table.source(), "'" + side + "' in this pair", "none");
    const auto* text = path->as_string();
    if (text == nullptr) fail(path->source(), "a file name in quotes after '" + side + " ='", type_name(*path));
    if (text->get().empty()) fail(path->source(), "a file name", "an empty string");
    PairedClip clip{(folder_ / text->get()).lexically_normal().string(), std::nullopt, path->source().begin.line,
                    path->source().begin.column};
    if (const toml::node* range = table.get(side + "_frames")) {
      clip.frames = frames(*range);
      clip.line = range->source().begin.line;
      clip.column = range->source().begin.column;
    }
    return clip;
  }

  motion::FrameRange frames(const toml::node& node) const {
    static constexpr const char* kExpected = "two whole numbers: [first, end)";
    const toml::array* range = node.as_array();
    if (range == nullptr) fail(node.source(), kExpected, type_name(node));
    if (range->size() != 2) fail(node.source(), kExpected, std::to_string(range->size()));
    const int begin = frame(*range->get(0));
    const int end = frame(*range->get(1));
    if (end <= begin) {
      fail(range->get(1)->source(), "an end after frame " + std::to_string(begin), std::to_string(end),
           "the end itself is not included: [30, 96] is frames 30 to 95");
    }
    return {begin, end};
  }

  int frame(const toml::node& node) const {
    const auto* number = node.as_integer();
    if (number == nullptr) fail(node.source(), "a whole number", type_name(node));
    if (number->get() < 0) fail(node.source(), "a frame, from 0", std::to_string(number->get()));
    if (number->get() > std::numeric_limits<int>::max()) {
      fail(node.source(), "a frame", std::to_string(number->get()));
    }
    return static_cast<int>(number->get());
  }

  [[noreturn]] void fail(const toml::source_region& where, const std::string& expected, const std::string& found,
                         const std::string& hint = {}) const {
    throw ParseError(path_, where.begin.line, where.begin.column, expected, found, hint);
  }

  std::string path_;
  fs::path folder_;
};

/// `text` as a TOML basic string.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    char code[8];
    std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (c == '"' || c == '\\') result += '\\';
    result += is_control ? std::string(code) : std::string(1, c);
  }
  return result + "\"";
}

/// Every line of `text` as a comment.
std::string commented(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    // A control character would end the comment or the file's validity.
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    result += line.empty() ? "#\n" : "# " + line + "\n";
  }
  return result;
}

/// The clip's path as seen from `folder`; absolute where there is no way from one to the other.
std::string relative_to(const fs::path& folder, const std::string& clip) {
  const fs::path absolute = fs::absolute(clip).lexically_normal();
  const fs::path relative = absolute.lexically_relative(fs::absolute(folder).lexically_normal());
  return relative.empty() ? absolute.string() : relative.string();
}

std::string frames_line(const char* key, const std::optional<motion::FrameRange>& frames) {
  if (!frames) return {};
  if (frames->begin < 0 || frames->end <= frames->begin) {
    throw InvalidArgument(key, "a range from 0 with its end after its beginning",
                          std::to_string(frames->begin) + " to " + std::to_string(frames->end));
  }
  return std::string(key) + " = [" + std::to_string(frames->begin) + ", " + std::to_string(frames->end) + "]\n";
}

/// The TOML parser's description, e.g. "Error while parsing key-value pair: expected '=', saw 'x'", in the words of our
/// other messages.
[[noreturn]] void refuse(const std::string& path, const toml::parse_error& error) {
  static const std::regex kDescription("Error while parsing ([^:]*): (?:expected ([^]*), saw )?([^]*)");
  static const std::regex kStructure("key|key-value pair|.*table.*");
  const std::string text(error.description());
  std::smatch part;
  std::string expected = "a pair list in TOML", found = text;
  if (std::regex_match(text, part, kDescription)) {
    found = part[3];
    if (!std::regex_match(part[1].str(), kStructure)) {
      expected = "a file name in quotes or whole numbers";
    } else if (part[2].matched) {
      expected = part[2];
    }
  }
  throw ParseError(path, error.source().begin.line, error.source().begin.column, expected, found,
                   "a pair list is made by strut pair");
}

/// Where the pairs of a list stand that was read without complaint.
std::vector<io::detail::LineSpan> lines_of(const toml::table& root) {
  std::vector<io::detail::LineSpan> spans;
  for (const toml::node& node : *root.get_as<toml::array>("pair")) {
    io::detail::LineSpan span{node.source().begin.line, node.source().begin.line};
    for (const auto& [key, value] : *node.as_table())
      span.last = std::max<std::size_t>(span.last, value.source().end.line);
    spans.push_back(span);
  }
  return spans;
}

/// A list with its comments; rejected pairs are still comments.
PairList read_with_comments(std::string_view text, const std::string& path) {
  try {
    const toml::table root = toml::parse(text, path);
    PairList list;
    list.pairs = Reader(path).read(root);
    io::detail::PairListComments comments = io::detail::comments_of(text, lines_of(root));
    list.heading = std::move(comments.heading);
    list.ending = std::move(comments.ending);
    for (std::size_t i = 0; i < list.pairs.size(); ++i) list.pairs[i].comment = std::move(comments.of_pairs[i]);
    return list;
  } catch (const toml::parse_error& error) {
    refuse(path, error);
  }
}

/// What stands above the rejected pairs.
constexpr const char* kRejected = "Rejected. Taking the first \"# \" of its lines away brings a pair back.";

/// `text` without its lines that read `line`, and without blank lines at its ends.
std::string without(const std::string& text, const std::string& line) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string each; std::getline(lines, each);) {
    if (each != line) kept += each + "\n";
  }
  kept.erase(kept.find_last_not_of('\n') + 1);
  return kept.erase(0, kept.find_first_not_of('\n'));
}

/// Moves the pairs out of the commented list that begins at `begin` of the ending; false if there is no such list.
bool take_rejected(PairList& list, std::size_t begin, const std::string& path) {
  PairList taken;
  try {
    taken = read_with_comments(std::string_view(list.ending).substr(begin), path);
  } catch (const ParseError&) {
    return false;  // a person's words: they stay as they are
  }
  for (PairListEntry& entry : taken.pairs) {
    entry.comment = without(entry.comment, kRejected);
    entry.input.line = entry.input.column = entry.output.line = entry.output.column = 0;  // not those of the file
  }
  list.rejected = std::move(taken.pairs);
  list.ending = without(list.ending.substr(0, begin) + "\n" + taken.heading + "\n" + taken.ending, kRejected);
  return true;
}

std::string format_pairs(const std::vector<PairListEntry>& pairs, const fs::path& folder, const std::string& heading) {
  std::string text = commented(heading);
  for (const PairListEntry& pair : pairs) {
    if (!text.empty()) text += "\n";
    text += commented(pair.comment);
    text += "[[pair]]\n";
    text += "input = " + quoted(relative_to(folder, pair.input.path)) + "\n";
    text += "output = " + quoted(relative_to(folder, pair.output.path)) + "\n";
    text += frames_line("input_frames", pair.input.frames);
    text += frames_line("output_frames", pair.output.frames);
  }
  return text;
}

}  // namespace

std::vector<PairListEntry> parse_pair_list(std::string_view text, const std::string& path) {
  return read_with_comments(text, path).pairs;
}

PairList parse_annotated_pair_list(std::string_view text, const std::string& path) {
  PairList list = read_with_comments(text, path);
  const std::string mark = std::string("# ") + kRejected;
  for (auto at = list.ending.find(mark); at != std::string::npos; at = list.ending.find(mark, at + 1)) {
    if (take_rejected(list, at, path)) break;
  }
  return list;
}

std::vector<PairListEntry> read_pair_list(const std::string& path) {
  return parse_pair_list(read_file(path), path);
}

motion::FrameRange frames_within(const PairedClip& clip, int num_frames, const std::string& list_path) {
  if (num_frames <= 0) throw ParseError(list_path, clip.line, clip.column, "a clip with frames", "'" + clip.path + "'");
  if (!clip.frames) return {0, num_frames};
  if (clip.frames->end > num_frames) {
    throw ParseError(list_path, clip.line, clip.column,
                     "frames within 0 and " + std::to_string(num_frames) + ", as '" + clip.path + "' has",
                     std::to_string(clip.frames->begin) + " to " + std::to_string(clip.frames->end));
  }
  return *clip.frames;
}

std::string format_pair_list(const PairList& list, const std::string& path) {
  if (list.pairs.empty()) throw InvalidArgument("pairs", "at least one pair", "none");
  const fs::path folder = fs::absolute(path).parent_path();
  std::string text = format_pairs(list.pairs, folder, list.heading);
  if (!list.ending.empty()) text += "\n" + commented(list.ending);
  if (!list.rejected.empty()) text += "\n" + commented(format_pairs(list.rejected, folder, kRejected));
  return text;
}

std::string format_pair_list(const std::vector<PairListEntry>& pairs, const std::string& path,
                             const std::string& heading) {
  return format_pair_list(PairList{heading, pairs, {}, {}}, path);
}

void write_pair_list(const std::string& path, const std::vector<PairListEntry>& pairs, const std::string& heading,
                     Overwrite overwrite) {
  write_file(path, format_pair_list(pairs, path, heading), overwrite);
}

}  // namespace strut
