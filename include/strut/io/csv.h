// SPDX-License-Identifier: MIT
// Tables as comma-separated values with a line of names at the top, as spreadsheets write and read them: text in,
// fields that know where they stand out, so that whoever reads a table can say what is wrong with which field.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strut {

/// One field of a line.
struct CsvField {
  std::string text;        ///< without blanks around it and without quotes
  std::size_t column = 0;  ///< where it begins in its line, from 1
};

/// One line of a table.
struct CsvLine {
  std::size_t line = 0;  ///< from 1
  std::vector<CsvField> fields;
};

/// A table.
struct CsvTable {
  std::string path;  ///< of the file, for messages
  CsvLine header;
  std::vector<CsvLine> rows;  ///< each with as many fields as the header

  /// Where the column called `name` is; none if it is not there. Throws ParseError if it is there twice.
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;
  /// The same, but throws ParseError, naming the columns that are there, if it is not.
  [[nodiscard]] std::size_t place_of(const std::string& name) const;
};

/// Reads a table. A field may stand in double quotes, a quote within it doubled; it ends with its line. Blank lines are
/// allowed at the end only. LF and CRLF, with or without a byte order mark. Throws FileError if it cannot be read,
/// ParseError (line and column) for an empty file, lines of other lengths than the header's and quotes that do not fit.
CsvTable read_csv(const std::string& path);

/// The same from text; `path` stands for the file in messages.
CsvTable parse_csv(std::string_view text, const std::string& path);

/// The finite decimal number in a field of `line` of the file at `path`. Throws ParseError.
double csv_number(const CsvField& field, std::size_t line, const std::string& path);

/// `text` as a field to be written: in quotes where it needs them.
std::string csv_field(std::string_view text);

}  // namespace strut
