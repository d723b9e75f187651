// SPDX-License-Identifier: MIT
#include "architecture/include_order.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace strut::test {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> kSurfaces = {"cli", "bench", "tests", "examples"};
const std::set<std::string> kSystemHeaders = {"fcntl.h",  "math.h",  "poll.h",   "signal.h", "spawn.h", "stddef.h",
                                              "stdint.h", "stdio.h", "stdlib.h", "string.h", "sys",     "unistd.h"};
/// Headers made at build time, and the folder they belong to.
const std::map<std::string, std::string> kGenerated = {{"style_model_generated.h", "model"},
                                                       {"gait_model_generated.h", "blend"},
                                                       {"effort_model_generated.h", "effort"},
                                                       {"strut_version.h", "core"}};

struct Include {
  std::string name;
  bool is_quoted = false;
};

/// The folder a file belongs to: include/strut/math/x.h and src/math/x.cpp are of "math", cli/x.cpp of "cli",
/// include/strut/strut.h of "strut.h".
std::string folder_of(const fs::path& relative) {
  std::vector<std::string> parts;
  for (const auto& part : relative) parts.push_back(part.string());
  if (parts.size() > 2 && parts[0] == "include") return parts[2];
  if (parts.size() > 1 && parts[0] == "src") return parts[1];
  return parts.empty() ? "" : parts[0];
}

std::string first_part(const std::string& include) {
  return include.substr(0, include.find('/'));
}

bool is_standard(const std::string& include) {
  return include.find('.') == std::string::npos && include.find('/') == std::string::npos;
}

class Checker {
 public:
  Checker(fs::path root, const IncludeOrder& order) : root_(std::move(root)), order_(order) {}

  void check_file(const fs::path& file) {
    static const std::regex kPattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
    const fs::path relative = file.lexically_relative(root_);
    ++report.num_files;
    if (!order_.contains(folder_of(relative))) {
      report.violations.push_back(relative.string() + ": the table has no folder '" + folder_of(relative) + "'");
      return;
    }
    std::ifstream stream(file);
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      std::smatch match;
      if (!std::regex_match(line, match, kPattern)) continue;
      ++report.num_includes;
      const std::string fault = fault_of(relative, {match[2], match[1] == "\""});
      if (!fault.empty()) report.violations.push_back(relative.string() + ":" + std::to_string(number) + ": " + fault);
    }
  }

  IncludeReport report;

 private:
  /// What is wrong with an include; empty if nothing is.
  [[nodiscard]] std::string fault_of(const fs::path& file, const Include& include) const {
    const std::string from = folder_of(file);
    if (include.name.starts_with("strut/")) return fault_of_folder(from, folder_of("include/" + include.name), include);
    if (include.is_quoted) {
      const std::string to = folder_of_quoted(file, include.name);
      return to.empty() ? "\"" + include.name + "\" is nowhere" : fault_of_folder(from, to, include);
    }
    if (const auto generated = kGenerated.find(include.name); generated != kGenerated.end()) {
      return fault_of_folder(from, generated->second, include);
    }
    if (is_standard(include.name) || kSystemHeaders.contains(first_part(include.name))) return {};
    return fault_of_library(file, include.name);
  }

  [[nodiscard]] std::string fault_of_folder(const std::string& from, const std::string& to,
                                            const Include& include) const {
    const IncludeRule& rule = order_.at(from);
    if (from == to || rule.folders.contains(to) || (rule.any_folder && !kSurfaces.contains(to))) return {};
    return from + " may not include " + to + " (" + include.name + ")";
  }

  [[nodiscard]] std::string fault_of_library(const fs::path& file, const std::string& include) const {
    std::string library = first_part(include);
    if (library == include) library = fs::path(include).stem().string();
    const bool is_public = file.begin()->string() == "include";
    if (is_public && library != "Eigen") return "a public header may not include " + library + " (" + include + ")";
    if (order_.at(folder_of(file)).libraries.contains(library)) return {};
    return folder_of(file) + " may not include " + library + " (" + include + ")";
  }

  /// The folder of the file a quoted include means, by the include paths the build gives; empty if there is none.
  [[nodiscard]] std::string folder_of_quoted(const fs::path& file, const std::string& include) const {
    for (const fs::path& base : {file.parent_path(), fs::path("src"), fs::path("tests"), fs::path("cli")}) {
      const fs::path candidate = (base / include).lexically_normal();
      if (fs::exists(root_ / candidate)) return folder_of(candidate);
    }
    return {};
  }

  fs::path root_;
  const IncludeOrder& order_;
};

bool is_source(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp" || path.extension() == ".c";
}

std::set<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

}  // namespace

IncludeOrder read_include_order(const std::string& path) {
  IncludeOrder order;
  std::ifstream stream(path);
  std::string line;
  while (std::getline(stream, line)) {
    if (line.empty() || line.front() == '#') continue;
    const auto colon = line.find(':');
    const auto bar = line.find('|');
    if (colon == std::string::npos || bar == std::string::npos || bar < colon) throw std::runtime_error(line);
    IncludeRule rule;
    rule.folders = words(line.substr(colon + 1, bar - colon - 1));
    rule.any_folder = rule.folders.erase("any") > 0;
    rule.libraries = words(line.substr(bar + 1));
    order[line.substr(0, colon)] = rule;
  }
  return order;
}

IncludeReport check_includes(const std::string& root, const IncludeOrder& order) {
  const fs::path planted = fs::path(root) / "tests/architecture/violation";
  std::vector<fs::path> files;
  for (const char* top : {"include", "src", "cli", "bench", "tests", "examples"}) {
    if (!fs::exists(fs::path(root) / top)) continue;
    for (fs::recursive_directory_iterator entry(fs::path(root) / top), end; entry != end; ++entry) {
      if (entry->path() == planted) {
        entry.disable_recursion_pending();
      } else if (entry->is_regular_file() && is_source(entry->path())) {
        files.push_back(entry->path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  Checker checker(root, order);
  for (const fs::path& file : files) checker.check_file(file);
  return checker.report;
}

}  // namespace strut::test
