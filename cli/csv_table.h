// SPDX-License-Identifier: MIT
// Tables of numbers in text: comma-separated values with a line of names at the top.
#pragma once

#include <string>
#include <vector>

#include <strut/math/frame_matrix.h>

namespace strut::cli {

/// Some columns of a table, and the labels of its rows.
struct CsvColumns {
  FrameMatrix values;               ///< a row per line, a column per name asked for
  std::vector<std::string> labels;  ///< the label column's text per row; empty if none was asked for
};

/// A line of a table: the fields asked for, and where they stand.
struct CsvRow {
  std::size_t line = 0;                     ///< from 1
  std::vector<std::string> texts;           ///< of the columns of text, without quotes
  std::vector<double> numbers;              ///< of the columns of numbers
  std::vector<std::size_t> text_columns;    ///< where each begins in its line, from 1
  std::vector<std::size_t> number_columns;  ///< the same
};

/// The names in the first line of the file at `path`, which must have one. Throws FileError or ParseError.
std::vector<std::string> read_csv_names(const std::string& path);

/// The columns `texts` and `numbers` of the file at `path`, line by line; as strict as read_csv_columns.
std::vector<CsvRow> read_csv_rows(const std::string& path, const std::vector<std::string>& texts,
                                  const std::vector<std::string>& numbers);

/// The columns `names` of the file at `path`, in that order, and the text of column `label` (none if empty).
///
/// Strict: a line of names (each once, in double quotes or not), then lines of as many fields; blank lines are allowed
/// at the end only. A field of a column asked for is a finite decimal number; other columns may hold anything. LF and
/// CRLF, with or without a byte order mark. Throws FileError, or ParseError with line and column.
CsvColumns read_csv_columns(const std::string& path, const std::vector<std::string>& names, const std::string& label);

}  // namespace strut::cli
