// SPDX-License-Identifier: MIT
// The library prints nothing and never ends the process: read off what its archives ask of the C and C++ libraries. The
// C interface shows what its header declares and nothing else, and needs no library that strut brings along.
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/c/strut.h>

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

#ifdef STRUT_C_SHARED

TEST(CInterface, NeitherPrintsNorEndsTheProcess) {
  int members = 0;
  EXPECT_THAT(forbidden_symbols(STRUT_C_ARCHIVE, members), IsEmpty());
  EXPECT_GT(members, 3) << "nm's output was not understood";
}

/// The names of the functions that the header declares.
std::set<std::string> declared_functions() {
  std::ifstream stream(std::string(STRUT_TEST_SOURCE_DIR) + "/include/strut/c/strut.h");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  static const std::regex kDeclaration(R"(\nSTRUT_C_API [a-z0-9_ *]+[ *](strut_[a-z_]+)\()");
  std::set<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), kDeclaration), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

TEST(CInterface, ShowsTheFunctionsOfItsHeaderAndNothingElse) {
  std::istringstream lines(output_of(STRUT_NM " -D --defined-only " STRUT_C_SHARED));
  std::set<std::string> shown;
  std::string address;
  std::string kind;
  for (std::string name; lines >> address >> kind >> name;) shown.insert(name);
  EXPECT_EQ(shown, declared_functions());
  EXPECT_GT(shown.size(), 20U);
}

TEST(CInterface, NeedsTheStandardLibrariesOnly) {
  std::istringstream lines(output_of(STRUT_READELF " -d " STRUT_C_SHARED));
  std::set<std::string> needed;
  std::string soname;
  for (std::string line; std::getline(lines, line);) {
    const auto open = line.find('[');
    if (open == std::string::npos) continue;
    const std::string name = line.substr(open + 1, line.find(']') - open - 1);
    if (line.find("(NEEDED)") != std::string::npos) needed.insert(name.substr(0, name.find(".so")));
    if (line.find("(SONAME)") != std::string::npos) soname = name;
  }
  EXPECT_THAT(needed, testing::IsSubsetOf({"libstdc++", "libm", "libgcc_s", "libc", "ld-linux-x86-64"}));
  EXPECT_THAT(needed, Contains("libc"));
  EXPECT_EQ(soname, "libstrut.so." + std::to_string(STRUT_ABI_VERSION));
}

#endif

}  // namespace
}  // namespace strut::test
