// SPDX-License-Identifier: MIT
// Whole files in and out: what can go wrong on a disk, and that nothing half-written is ever left.
#include "support/data.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/core/file.h>

namespace strut {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using testing::StartsWith;

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

std::size_t num_entries(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Runs `action` in a process of its own; its exit code, or minus the signal that ended it.
int in_a_child(const auto& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(ReadFile, GivesBackEveryByte) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 100000; ++i) bytes.push_back(static_cast<char>(i * 7));
  write_file(folder.file("bytes"), bytes);
  EXPECT_EQ(read_file(folder.file("bytes")), bytes);
  write_file(folder.file("empty"), "");
  EXPECT_EQ(read_file(folder.file("empty")), "");
}

TEST(ReadFile, ReadsWhatHasNoSize) {
  EXPECT_THAT(read_file("/proc/self/status"), StartsWith("Name:"));
  EXPECT_EQ(read_file("/dev/null"), "");
}

TEST(ReadFile, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string missing = folder.file("no.bvh");
  EXPECT_EQ(message_of([&] { read_file(missing); }), missing + ": error: cannot open: No such file or directory");
  try {
    read_file(missing);
  } catch (const FileError& error) {
    EXPECT_EQ(error.action(), FileAction::kRead);
  }
}

TEST(ReadFile, RefusesAFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of([&] { read_file(folder.path()); }), folder.path() + ": error: is a folder, not a file");
}

TEST(WriteFile, RefusesAnExistingFileAndLeavesItAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.bvh");
  write_file(path, "first");
  EXPECT_EQ(message_of([&] { write_file(path, "second"); }), path + ": error: the file already exists");
  EXPECT_EQ(read_file(path), "first");
  EXPECT_EQ(num_entries(folder.path()), 1U);
}

TEST(WriteFile, OverwritesWhenToldTo) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.bvh");
  write_file(path, "a first text that is longer");
  write_file(path, "second", Overwrite::kAllow);
  EXPECT_EQ(read_file(path), "second");
  EXPECT_EQ(num_entries(folder.path()), 1U);
}

TEST(WriteFile, GivesThePermissionsTheUmaskAsksFor) {
  const TemporaryFolder folder;
  const mode_t before = ::umask(027);
  write_file(folder.file("out.bvh"), "x");
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat(folder.file("out.bvh").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640U);
}

TEST(WriteFile, NamesAMissingFolder) {
  const TemporaryFolder folder;
  const std::string path = folder.file("nowhere/out.bvh");
  EXPECT_EQ(message_of([&] { write_file(path, "x"); }),
            path + ": error: there is no folder '" + folder.file("nowhere") + "' to write it to");
}

TEST(WriteFile, RefusesAFolder) {
  const TemporaryFolder folder;
  for (const Overwrite overwrite : {Overwrite::kRefuse, Overwrite::kAllow}) {
    EXPECT_EQ(message_of([&] { write_file(folder.path(), "x", overwrite); }),
              folder.path() + ": error: is a folder, not a file");
  }
}

TEST(WriteFile, WritesStraightThroughToDevices) {
  EXPECT_NO_THROW(write_file("/dev/null", "x"));
  EXPECT_EQ(message_of([] { write_file("/dev/full", "x"); }),
            "/dev/full: error: cannot write: No space left on device");
}

TEST(WriteFile, LeavesNothingWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.bvh");
  write_file(path, "before");
  // A limit on file sizes stands in for the full disk: write() then gives EFBIG, like ENOSPC an error after some bytes.
  const int code = in_a_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message = message_of([&] { write_file(path, std::string(100000, 'x'), Overwrite::kAllow); });
    ::_exit(message == path + ": error: cannot write: File too large" ? 7 : 1);
  });
  EXPECT_EQ(code, 7);
  EXPECT_EQ(read_file(path), "before");
  EXPECT_EQ(num_entries(folder.path()), 1U);
}

TEST(WriteFile, LeavesNothingWhenKilledInTheMiddle) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.bvh");
  // Past the limit, SIGXFSZ ends the process in the middle of its write, as kill would.
  const int code = in_a_child([&] {
    const rlimit limit{4096, 4096};
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::setrlimit(RLIMIT_CORE, &no_core);
    write_file(path, std::string(100000, 'x'));
  });
  EXPECT_EQ(code, -SIGXFSZ);
  EXPECT_EQ(num_entries(folder.path()), 0U);
}

TEST(WriteFile, FollowsALinkToAFile) {
  const TemporaryFolder folder;
  write_file(folder.file("target"), "before");
  fs::create_symlink("target", folder.file("link"));
  write_file(folder.file("link"), "after", Overwrite::kAllow);
  EXPECT_TRUE(fs::is_symlink(folder.file("link")));
  EXPECT_EQ(read_file(folder.file("target")), "after");
}

TEST(CheckWritable, RefusesWhatWriteFileWould) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.bvh");
  EXPECT_NO_THROW(check_writable(path, Overwrite::kRefuse));
  EXPECT_EQ(num_entries(folder.path()), 0U) << "it must not make the file";
  write_file(path, "x");
  EXPECT_NO_THROW(check_writable(path, Overwrite::kAllow));
  EXPECT_THROW(check_writable(path, Overwrite::kRefuse), FileError);
  EXPECT_THROW(check_writable(folder.file("nowhere/out.bvh"), Overwrite::kAllow), FileError);
  EXPECT_THROW(check_writable(folder.path(), Overwrite::kAllow), FileError);
}

}  // namespace
}  // namespace strut
