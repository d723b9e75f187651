// SPDX-License-Identifier: MIT
#include "csv_table.h"

#include <strut/core/error.h>
#include <strut/io/csv.h>

namespace strut::cli {

std::vector<std::string> read_csv_names(const std::string& path) {
  std::vector<std::string> names;
  for (const CsvField& field : read_csv(path).header.fields) names.push_back(field.text);
  return names;
}

std::vector<CsvRow> read_csv_rows(const std::string& path, const std::vector<std::string>& texts,
                                  const std::vector<std::string>& numbers) {
  const CsvTable table = read_csv(path);
  std::vector<std::size_t> text_places, number_places;
  for (const std::string& name : numbers) number_places.push_back(table.place_of(name));
  for (const std::string& name : texts) text_places.push_back(table.place_of(name));
  std::vector<CsvRow> rows;
  for (const CsvLine& line : table.rows) {
    CsvRow row{line.line, {}, {}, {}, {}};
    for (const std::size_t place : text_places) {
      row.texts.push_back(line.fields[place].text);
      row.text_columns.push_back(line.fields[place].column);
    }
    for (const std::size_t place : number_places) {
      row.numbers.push_back(csv_number(line.fields[place], line.line, path));
      row.number_columns.push_back(line.fields[place].column);
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw ParseError(path, table.header.line, 0, "a line of numbers", "the end of the file");
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
