// SPDX-License-Identifier: MIT
#include "correspondence_page.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace strut::study {

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string percent(double share) {
  return number(100.0 * share, 0) + " %";
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : between) + part;
  return all;
}

std::string Table::markdown() const {
  std::string text;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    text += "| " + joined(rows_[r], " | ") + " |\n";
    if (r > 0) continue;
    text += "| --- |";
    for (std::size_t c = 1; c < rows_[0].size(); ++c) text += " ---: |";
    text += "\n";
  }
  return text;
}

void write_page(const std::string& text_file, const std::string& page_file,
                const std::map<std::string, std::string>& parts) {
  std::ifstream text(text_file);
  if (!text) throw std::runtime_error("cannot read " + text_file);
  std::ostringstream page;
  std::set<std::string> used;
  for (std::string line; std::getline(text, line);) {
    const bool is_part = line.size() > 4 && line.starts_with("{{") && line.ends_with("}}");
    if (!is_part) {
      page << line << "\n";
      continue;
    }
    const auto part = parts.find(line.substr(2, line.size() - 4));
    if (part == parts.end()) throw std::runtime_error(text_file + ": no part " + line);
    used.insert(part->first);
    page << part->second;
  }
  for (const auto& [name, part] : parts) {
    if (!used.contains(name)) throw std::runtime_error(text_file + ": {{" + name + "}} is not asked for");
  }
  std::ofstream file(page_file);
  file << page.str();
  if (!file.flush()) throw std::runtime_error("cannot write " + page_file);
}

}  // namespace strut::study
