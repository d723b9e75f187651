// SPDX-License-Identifier: MIT
#include "support/live_program.h"

#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include <gtest/gtest.h>

namespace strut::test {
namespace {

constexpr int kPatience = 10'000;  // before a line is taken not to come [ms]
constexpr int kSilence = 100;      // that tells that nothing comes [ms]

struct Pipe {
  int read = -1, write = -1;
};

Pipe make_pipe() {
  int ends[2];
  EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  return {ends[0], ends[1]};
}

void close_once(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

bool is_ready(int fd, int milliseconds) {
  pollfd waited{fd, POLLIN, 0};
  return ::poll(&waited, 1, milliseconds) > 0;
}

}  // namespace

LiveProgram::LiveProgram(const std::string& program, const std::vector<std::string>& arguments) {
  std::signal(SIGPIPE, SIG_IGN);
  const Pipe in = make_pipe(), out = make_pipe(), err = make_pipe();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write, STDERR_FILENO);
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  EXPECT_EQ(::posix_spawn(&process_, program.c_str(), &actions, nullptr, pointers.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  for (const int end : {in.read, out.write, err.write}) ::close(end);
  input_ = in.write;
  output_ = out.read;
  error_ = err.read;
}

LiveProgram::~LiveProgram() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  for (int* fd : {&input_, &output_, &error_}) close_once(*fd);
}

void LiveProgram::write(const std::string& text) {
  EXPECT_EQ(::write(input_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

void LiveProgram::write_what_is_taken(const std::string& text) {
  std::size_t taken = 0;
  while (taken < text.size()) {
    const ssize_t count = ::write(input_, text.data() + taken, text.size() - taken);
    if (count <= 0) return;
    taken += static_cast<std::size_t>(count);
  }
}

void LiveProgram::close_input() {
  close_once(input_);
}

void LiveProgram::close_output() {
  close_once(output_);
}

std::string LiveProgram::read_line() {
  for (;;) {
    const auto end = read_.find('\n');
    if (end != std::string::npos) {
      std::string line = read_.substr(0, end + 1);
      read_.erase(0, end + 1);
      return line;
    }
    if (!is_ready(output_, kPatience)) return "(silence)";
    char bytes[4096];
    const ssize_t got = ::read(output_, bytes, sizeof bytes);
    if (got <= 0) return std::exchange(read_, {});
    read_.append(bytes, static_cast<std::size_t>(got));
  }
}

bool LiveProgram::is_silent() {
  return read_.empty() && !is_ready(output_, kSilence);
}

void LiveProgram::send(int signal) const {
  ::kill(process_, signal);
}

int LiveProgram::exit_code() {
  int status = 0;
  rusage usage{};
  EXPECT_EQ(::wait4(process_, &status, 0, &usage), process_);
  process_ = -1;
  peak_memory_ = 1024 * usage.ru_maxrss;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string LiveProgram::err() {
  std::string text;
  char bytes[4096];
  for (ssize_t got = 0; (got = ::read(error_, bytes, sizeof bytes)) > 0;) {
    text.append(bytes, static_cast<std::size_t>(got));
  }
  return text;
}

}  // namespace strut::test
