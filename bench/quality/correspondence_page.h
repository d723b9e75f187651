// SPDX-License-Identifier: MIT
// Tables in Markdown, and a page whose text is a file and whose tables are made.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace strut::study {

/// A number with two decimals (or so many), a share in percent, and "a / b / c".
std::string number(double value, int decimals = 2);
std::string percent(double share);
std::string joined(const std::vector<std::string>& parts, const char* between);

/// A table: the first column is text, the others are numbers.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : rows_{std::move(head)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  [[nodiscard]] std::string markdown() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Writes `text_file` to `page_file` with every line {{name}} replaced by parts[name].
/// Throws std::runtime_error if a file cannot be read or written, a name is unknown, or a part is not asked for.
void write_page(const std::string& text_file, const std::string& page_file,
                const std::map<std::string, std::string>& parts);

}  // namespace strut::study
