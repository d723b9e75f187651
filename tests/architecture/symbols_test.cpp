// SPDX-License-Identifier: MIT
// The library prints nothing and never ends the process: read off what its archives ask of the C and C++ libraries.
#include <array>
#include <cstdio>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strut::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::string output_of(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 4096> block{};
  for (std::size_t got = 0; (got = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
    text.append(block.data(), got);
  if (::pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
  return text;
}

bool speaks_or_ends(const std::string& symbol) {
  static const std::set<std::string> kForbidden = {
      "std::cout", "std::cerr", "std::clog",  "stdout",    "stderr", "printf",       "fprintf",      "vprintf",
      "vfprintf",  "puts",      "fputs",      "putchar",   "fwrite", "__printf_chk", "perror",       "__fprintf_chk",
      "abort",     "exit",      "quick_exit", "std::exit", "_exit",  "std::abort",   "__vprintf_chk"};
  return kForbidden.contains(symbol.substr(0, symbol.find('@')));
}

/// "file.cpp.o: symbol" for every forbidden symbol an archive's members leave undefined.
std::set<std::string> forbidden_symbols(const std::string& archive, int& num_members) {
  std::istringstream lines(output_of(STRUT_NM " -u -C " + archive));
  std::set<std::string> found;
  std::string line;
  std::string member;
  while (std::getline(lines, line)) {
    if (line.ends_with(".o:")) {
      member = line.substr(0, line.size() - 1);
      ++num_members;
    } else if (const auto at = line.find_last_not_of(' '); at != std::string::npos) {
      const auto start = line.find("U ");
      if (start == std::string::npos) continue;
      const std::string symbol = line.substr(start + 2, at - start - 1);
      if (speaks_or_ends(symbol)) found.insert(member + ": " + symbol);
    }
  }
  return found;
}

TEST(Library, NeitherPrintsNorEndsTheProcess) {
  int members = 0;
  EXPECT_THAT(forbidden_symbols(STRUT_RUNTIME_ARCHIVE, members), IsEmpty());
  EXPECT_THAT(forbidden_symbols(STRUT_LIBRARY_ARCHIVE, members), IsEmpty());
  EXPECT_GT(members, 30) << "nm's output was not understood";
}

TEST(Library, IsSeenToPrintWhereItIsPlanted) {
  int members = 0;
  const auto found = forbidden_symbols(STRUT_PLANTED_ARCHIVE, members);
  EXPECT_EQ(members, 1);
  EXPECT_THAT(found, Contains(HasSubstr("std::cout")));
  EXPECT_THAT(found, Contains(HasSubstr("puts")));
  EXPECT_THAT(found, Contains(HasSubstr("abort")));
  EXPECT_THAT(found, Contains(HasSubstr("exit")));
}

}  // namespace
}  // namespace strut::test
