// SPDX-License-Identifier: MIT
#include "csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/core/file.h>

namespace strut::cli {
namespace {

struct Field {
  std::string_view text;  ///< without blanks around it and without quotes
  std::size_t column;     ///< where it begins, from 1
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return "'" + std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "..." : "") + "'";
}

/// Splits a file into lines and lines into fields, and says where it stands.
class Reader {
 public:
  Reader(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  /// The next line's fields; none at the end of the file.
  std::vector<Field> next() {
    ++line_;
    if (text_.empty()) return {};
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    const std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    return fields(line);
  }
  [[nodiscard]] bool only_blank_left() const { return text_.find_first_not_of(" \t\r\n") == std::string_view::npos; }
  [[noreturn]] void fail(std::size_t column, const std::string& expected, const std::string& found,
                         const std::string& hint = {}) const {
    throw ParseError(path_, line_, column, expected, found, hint);
  }

 private:
  [[nodiscard]] std::vector<Field> fields(std::string_view line) const {
    std::vector<Field> out;
    std::size_t at = 0;
    do {
      const std::size_t begin = at;
      const std::size_t quote = line.find_first_not_of(" \t", begin);
      const bool is_quoted = quote != std::string_view::npos && line[quote] == '"';
      const std::size_t close = is_quoted ? line.find('"', quote + 1) : begin;
      if (close == std::string_view::npos) fail(quote + 1, "a closing quote", "the end of the line");
      const std::size_t comma = std::min(line.find(',', close), line.size());
      std::string_view text = trimmed(line.substr(begin, comma - begin));
      if (is_quoted && (text.size() < 2 || text.back() != '"' || text.find('"', 1) != text.size() - 1)) {
        fail(quote + 1, "a field that ends with its quote", quoted(text));
      }
      out.push_back(
          {is_quoted ? text.substr(1, text.size() - 2) : text, (quote == std::string_view::npos ? begin : quote) + 1});
      at = comma + 1;
    } while (at <= line.size());
    return out;
  }

  std::string path_;
  std::string_view text_;
  std::size_t line_ = 0;
};

std::string list_of(const std::vector<Field>& header) {
  std::string names;
  for (const Field& field : header) names += (names.empty() ? "" : ", ") + std::string(field.text);
  return names;
}

std::size_t place_of(const std::string& name, const std::vector<Field>& header, const Reader& reader) {
  const auto is_it = [&](const Field& field) { return field.text == name; };
  const auto found = std::find_if(header.begin(), header.end(), is_it);
  if (found == header.end()) {
    reader.fail(0, "a column named '" + name + "'", "none", "the columns are: " + list_of(header));
  }
  const auto again = std::find_if(found + 1, header.end(), is_it);
  if (again != header.end()) reader.fail(again->column, "every name once", "'" + name + "' again");
  return static_cast<std::size_t>(found - header.begin());
}

double number_of(const Field& field, const Reader& reader) {
  double number = std::nan("");
  const std::string_view digits = field.text.starts_with('+') ? field.text.substr(1) : field.text;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_whole = problem == std::errc() && end == digits.data() + digits.size();
  if (!is_whole || !std::isfinite(number)) reader.fail(field.column, "a finite number", quoted(field.text));
  return number;
}

}  // namespace

std::vector<std::string> read_csv_names(const std::string& path) {
  const std::string text = read_file(path);
  Reader reader(path, text);
  if (reader.only_blank_left()) reader.fail(0, "a line of column names", "nothing");
  std::vector<std::string> names;
  for (const Field& field : reader.next()) names.emplace_back(field.text);
  return names;
}

std::vector<CsvRow> read_csv_rows(const std::string& path, const std::vector<std::string>& texts,
                                  const std::vector<std::string>& numbers) {
  const std::string text = read_file(path);
  Reader reader(path, text);
  if (reader.only_blank_left()) reader.fail(0, "a line of column names", "nothing");
  const std::vector<Field> header = reader.next();
  std::vector<std::size_t> text_places, number_places;
  for (const std::string& name : numbers) number_places.push_back(place_of(name, header, reader));
  for (const std::string& name : texts) text_places.push_back(place_of(name, header, reader));
  std::vector<CsvRow> rows;
  while (!reader.only_blank_left()) {
    const std::vector<Field> fields = reader.next();
    if (fields.size() != header.size()) {
      reader.fail(0, fmt::format("{} fields", header.size()), fmt::format("{}", fields.size()));
    }
    CsvRow row{rows.size() + 2, {}, {}, {}, {}};
    for (const std::size_t place : text_places) {
      row.texts.emplace_back(fields[place].text);
      row.text_columns.push_back(fields[place].column);
    }
    for (const std::size_t place : number_places) {
      row.numbers.push_back(number_of(fields[place], reader));
      row.number_columns.push_back(fields[place].column);
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) reader.fail(0, "a line of numbers", "the end of the file");
  return rows;
}

CsvColumns read_csv_columns(const std::string& path, const std::vector<std::string>& names, const std::string& label) {
  const std::vector<CsvRow> rows =
      read_csv_rows(path, label.empty() ? std::vector<std::string>{} : std::vector{label}, names);
  CsvColumns table{FrameMatrix(std::ssize(rows), std::ssize(names)), {}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      table.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = rows[i].numbers[k];
    }
    table.labels.insert(table.labels.end(), rows[i].texts.begin(), rows[i].texts.end());
  }
  return table;
}

}  // namespace strut::cli
