// SPDX-License-Identifier: MIT
// Holds a source tree against the table of who may include whom (include_order.txt): reads every #include under
// include/, src/, cli/, bench/, tests/ and examples/ and says which of them the table does not allow.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace strut::test {

/// What the files of one folder may include.
struct IncludeRule {
  bool any_folder = false;          ///< every folder of the library, but not cli, bench, tests, examples
  std::set<std::string> folders;    ///< beside its own
  std::set<std::string> libraries;  ///< first part of the include's path, e.g. "Eigen"
};

using IncludeOrder = std::map<std::string, IncludeRule>;

/// Reads the table. Throws std::runtime_error on a line that has another form.
IncludeOrder read_include_order(const std::string& path);

struct IncludeReport {
  int num_files = 0;
  int num_includes = 0;
  std::vector<std::string> violations;  ///< "file:line: what is not allowed"
};

/// Checks the tree below `root`; tests/architecture/violation, which is wrong on purpose, is left out unless it is the
/// root itself.
IncludeReport check_includes(const std::string& root, const IncludeOrder& order);

}  // namespace strut::test
