// SPDX-License-Identifier: MIT
// The fragment database when a writer is killed or two write at once: whole transactions only.
#include "effort/small_database.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>

namespace strut::test {
namespace {

using namespace effort;
using motion::FrameRange;

/// Adds clips "0", "1", ... of this many fragments and labels one of each, until it is killed.
[[noreturn]] void write_until_killed(const std::string& path, const Motion& motion) {
  FragmentDatabase database = FragmentDatabase::open(path, Access::kReadWrite);
  for (int i = static_cast<int>(database.clips().size());; ++i) {
    FragmentDatabase::Transaction transaction(database);
    database.add_clip({std::to_string(i), "", ""}, motion, {{0, 30}, {30, 60}, {60, 90}});
    LabelRecord label;
    label.target.id = database.fragments().back().id;
    label.rater = "eve";
    label.labelled_at = kNoon;
    label.rating[kFlow] = 0.0;
    database.add_labels({label});
    transaction.commit();
    // Tells what is committed.
    if (::write(STDOUT_FILENO, "+", 1) != 1) ::_exit(1);
  }
}

/// Runs the writer in a process of its own, kills it after `delay`; how often it said that it has committed.
int commits_until_killed(const std::string& path, const Motion& motion, std::chrono::microseconds delay) {
  int ends[2];
  if (::pipe(ends) != 0) return -1;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    write_until_killed(path, motion);
  }
  ::close(ends[1]);
  std::this_thread::sleep_for(delay);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  int commits = 0;
  for (char said = 0; ::read(ends[0], &said, 1) == 1;) ++commits;
  ::close(ends[0]);
  return WIFSIGNALED(status) ? commits : -1;
}

TEST_F(FragmentDatabaseTest, AKilledWriterLosesNothingCommittedAndLeavesNoHalf) {
  constexpr int kRounds = 40;
  made();
  std::mt19937 random(3);
  std::int64_t told = 0, interrupted = 0;
  for (int round = 0; round < kRounds; ++round) {
    const int commits = commits_until_killed(path_, walk_, std::chrono::microseconds(1000 + random() % 40000));
    ASSERT_GE(commits, 0);
    told += commits;
    interrupted += std::filesystem::exists(path_ + "-journal") ? 1 : 0;
    const FragmentDatabase database = FragmentDatabase::open(path_);
    const DatabaseCounts counts = database.counts();
    // The last commit may have been done and not told.
    ASSERT_TRUE(counts.clips == told || counts.clips == told + 1) << counts.clips << " of " << told;
    told = counts.clips;
    ASSERT_EQ(counts.fragments, 3 * counts.clips);
    ASSERT_EQ(counts.labels, counts.clips);
    ASSERT_NO_THROW(database.check_integrity());
  }
  EXPECT_GT(told, 0);
  EXPECT_GT(interrupted, 0) << "no round was killed while it wrote";
}

TEST_F(FragmentDatabaseTest, TwoWritersTakeTurns) {
  filled();
  FragmentDatabase one = FragmentDatabase::open(path_, Access::kReadWrite);
  std::thread other([&] {
    FragmentDatabase two = FragmentDatabase::open(path_, Access::kReadWrite);
    for (int i = 0; i < 20; ++i) two.add_blend(1, 2, 0.01 * i);
  });
  for (int i = 0; i < 20; ++i) one.add_blend(2, 3, 0.01 * i);
  other.join();
  EXPECT_EQ(one.counts().blends, 40);
}

}  // namespace
}  // namespace strut::test
