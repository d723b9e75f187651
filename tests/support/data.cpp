// SPDX-License-Identifier: MIT
#include "support/data.h"

#include <cstdlib>
#include <filesystem>

namespace strut::test {

std::string test_file(const std::string& relative) {
  return std::string(STRUT_TEST_SOURCE_DIR) + "/tests/" + relative;
}

std::string real_data() {
  const char* named = std::getenv("STRUT_DATA");
  const std::string folder = named != nullptr ? named : std::string(STRUT_TEST_SOURCE_DIR) + "/../shared/data";
  return std::filesystem::is_directory(folder + "/bandai-namco") ? folder : std::string();
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "strut_test_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace strut::test
