// SPDX-License-Identifier: MIT
// Where the tests find files: those that ship with the tests, and the real clips that do not.
#pragma once

#include <string>

#include <gtest/gtest.h>

namespace strut::test {

/// A file under tests/, e.g. test_file("data/two_joints.bvh").
std::string test_file(const std::string& relative);

/// The folder of real data: $STRUT_DATA, else ../shared/data beside the checkout; empty where it is missing.
std::string real_data();

/// A fresh folder of this test's own, removed when the object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace strut::test

/// Skips the test with one line where the real clips are missing.
#define STRUT_REQUIRE_REAL_DATA()                                                                      \
  if (strut::test::real_data().empty()) {                                                              \
    GTEST_SKIP() << "needs the real clips: set STRUT_DATA to the folder that has bandai-namco/ in it"; \
  }
