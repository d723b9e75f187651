// SPDX-License-Identifier: MIT
// Tables that the program wrote, read back.
#pragma once

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <strut/core/file.h>

namespace strut::test {

/// A table's columns by name.
inline std::map<std::string, std::vector<double>> columns_of(const std::string& path) {
  std::istringstream lines(read_file(path));
  std::string line, field;
  std::vector<std::string> names;
  std::getline(lines, line);
  for (std::istringstream fields(line); std::getline(fields, field, ',');) names.push_back(field);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    for (const std::string& name : names) {
      std::getline(fields, field, ',');
      columns[name].push_back(std::strtod(field.c_str(), nullptr));
    }
  }
  return columns;
}

}  // namespace strut::test
