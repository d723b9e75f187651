// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/io/csv.h>

namespace strut {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return "'" + std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "..." : "") + "'";
}

/// Splits a file into lines and lines into fields, and knows where it stands.
class Reader {
 public:
  Reader(const std::string& path, std::string_view text) : path_(path), text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  CsvLine next() {
    ++line_;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    const std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    return {line_, fields(line)};
  }
  [[nodiscard]] bool only_blank_left() const { return text_.find_first_not_of(" \t\r\n") == std::string_view::npos; }
  [[noreturn]] void fail(std::size_t column, const std::string& expected, const std::string& found) const {
    throw ParseError(path_, line_, column, expected, found);
  }

 private:
  [[nodiscard]] std::vector<CsvField> fields(std::string_view line) const {
    std::vector<CsvField> out;
    std::size_t at = 0;
    do {
      const std::size_t first = line.find_first_not_of(" \t", at);
      const bool is_quoted = first != std::string_view::npos && line[first] == '"';
      const std::size_t begin = first == std::string_view::npos ? at : first;
      CsvField field{{}, begin + 1};
      const std::size_t end = is_quoted ? close_quote(line, begin, field.text) : begin;
      const std::size_t comma = std::min(line.find(',', end), line.size());
      const std::string_view rest = trimmed(line.substr(end, comma - end));
      if (!is_quoted) field.text = trimmed(line.substr(at, comma - at));
      if (is_quoted && !rest.empty()) {
        fail(begin + 1, "a field that ends with its quote", quoted(trimmed(line.substr(begin, comma - begin))));
      }
      out.push_back(std::move(field));
      at = comma + 1;
    } while (at <= line.size());
    return out;
  }

  /// Takes what stands in the quotes that open at `open`; where it goes on behind them.
  std::size_t close_quote(std::string_view line, std::size_t open, std::string& text) const {
    for (std::size_t at = open + 1; at < line.size(); ++at) {
      if (line[at] == '"') {
        if (at + 1 >= line.size() || line[at + 1] != '"') return at + 1;
        ++at;
      }
      text += line[at];
    }
    fail(open + 1, "a closing quote", "the end of the line");
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t line_ = 0;
};

std::string list_of(const CsvLine& header) {
  std::string names;
  for (const CsvField& field : header.fields) names += (names.empty() ? "" : ", ") + field.text;
  return names;
}

}  // namespace

std::optional<std::size_t> CsvTable::find(const std::string& name) const {
  const auto is_it = [&](const CsvField& field) { return field.text == name; };
  const auto found = std::find_if(header.fields.begin(), header.fields.end(), is_it);
  if (found == header.fields.end()) return std::nullopt;
  const auto again = std::find_if(found + 1, header.fields.end(), is_it);
  if (again != header.fields.end()) {
    throw ParseError(path, header.line, again->column, "every name once", "'" + name + "' again");
  }
  return static_cast<std::size_t>(found - header.fields.begin());
}

std::size_t CsvTable::place_of(const std::string& name) const {
  const auto place = find(name);
  if (place) return *place;
  throw ParseError(path, header.line, 0, "a column named '" + name + "'", "none",
                   "the columns are: " + list_of(header));
}

CsvTable read_csv(const std::string& path) {
  return parse_csv(read_file(path), path);
}

CsvTable parse_csv(std::string_view text, const std::string& path) {
  Reader reader(path, text);
  CsvTable table{path, {}, {}};
  if (reader.only_blank_left()) throw ParseError(path, 1, 0, "a line of column names", "nothing");
  table.header = reader.next();
  while (!reader.only_blank_left()) {
    table.rows.push_back(reader.next());
    const std::size_t found = table.rows.back().fields.size();
    if (found != table.header.fields.size()) {
      reader.fail(0, std::to_string(table.header.fields.size()) + " fields", std::to_string(found));
    }
  }
  return table;
}

double csv_number(const CsvField& field, std::size_t line, const std::string& path) {
  double number = std::nan("");
  std::string_view digits = field.text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_whole = problem == std::errc() && end == digits.data() + digits.size();
  if (is_whole && std::isfinite(number)) return number;
  throw ParseError(path, line, field.column, "a finite number", quoted(field.text));
}

std::string csv_field(std::string_view text) {
  const bool is_plain = text.find_first_of(",\"") == std::string_view::npos && trimmed(text) == text;
  if (is_plain) return std::string(text);
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

}  // namespace strut
