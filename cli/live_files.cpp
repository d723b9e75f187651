// SPDX-License-Identifier: MIT
// A signal handler may do next to nothing: it writes a byte to a pipe that every wait listens to.
#include "live_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <strut/core/error.h>

namespace strut::cli {
namespace {

constexpr int kGrowthInterval = 5;  // how often a followed file is looked at [ms]; a frame lasts 4 to 40

int interrupt_pipe[2] = {-1, -1};  // NOLINT: a signal handler can be given nothing

extern "C" void note_interrupt(int /*signal*/) {
  const int error = errno;
  const char byte = 0;
  [[maybe_unused]] const ssize_t written = ::write(interrupt_pipe[1], &byte, 1);
  errno = error;
}

std::string reason() {
  return std::strerror(errno);
}

bool is_standard(const std::string& path) {
  return path == "-";
}

int opened_for_reading(const std::string& path) {
  if (is_standard(path)) return STDIN_FILENO;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw FileError(FileAction::kRead, path, "cannot open: " + reason());
  struct stat status {};
  if (::fstat(fd, &status) == 0 && S_ISDIR(status.st_mode)) {
    ::close(fd);
    throw FileError(FileAction::kRead, path, "is a folder, not a file");
  }
  return fd;
}

int opened_for_writing(const std::string& path, Overwrite overwrite) {
  if (is_standard(path)) return STDOUT_FILENO;
  struct stat status {};
  const bool is_device = ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
  const int made = is_device ? 0 : O_CREAT | (overwrite == Overwrite::kAllow ? O_TRUNC : O_EXCL);
  const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | made, 0666);
  if (fd < 0) throw FileError(FileAction::kWrite, path, "cannot open: " + reason());
  return fd;
}

}  // namespace

InterruptSignals::InterruptSignals() {
  if (::pipe2(interrupt_pipe, O_CLOEXEC | O_NONBLOCK) != 0) {
    throw Error("cannot listen to interrupts: " + reason());
  }
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESETHAND;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

InterruptSignals::~InterruptSignals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGPIPE, SIG_DFL);
  for (int& end : interrupt_pipe) {
    ::close(end);
    end = -1;
  }
}

void InterruptSignals::wait(int fd, short events, int milliseconds) const {
  std::array<pollfd, 2> waited = {{{interrupt_pipe[0], POLLIN, 0}, {fd, events, 0}}};
  while (::poll(waited.data(), waited.size(), milliseconds) < 0) {
    if (errno != EINTR) throw Error("cannot wait for input or output: " + reason());
  }
  if (waited[0].revents != 0) throw Interrupted();
}

LiveInput::LiveInput(const std::string& path, const InterruptSignals& signals)
    : path_(is_standard(path) ? "<stdin>" : path), signals_(signals), fd_(opened_for_reading(path)) {}

LiveInput::~LiveInput() {
  if (fd_ != STDIN_FILENO) ::close(fd_);
}

std::size_t LiveInput::read_some(char* to, std::size_t size) {
  for (;;) {
    signals_.wait(fd_, POLLIN, -1);
    const ssize_t got = ::read(fd_, to, size);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) throw FileError(FileAction::kRead, path_, "cannot read: " + reason());
    num_read_ += static_cast<std::size_t>(got);
    return static_cast<std::size_t>(got);
  }
}

std::size_t LiveInput::read(char* to, std::size_t size) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  for (;;) {
    const std::size_t got = read_some(to, size);
    if (got > 0 || !following_) return got;
    if (following_->is_complete && following_->is_complete()) return 0;
    const std::chrono::duration<double> waited = Clock::now() - begin;
    if (following_->idle && waited.count() >= *following_->idle) return 0;
    check_not_cut();
    signals_.wait(-1, 0, kGrowthInterval);
  }
}

/// Where a followed file became shorter, what comes next is another recording's.
void LiveInput::check_not_cut() {
  struct stat status {};
  if (::fstat(fd_, &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (static_cast<std::size_t>(status.st_size) < num_read_) {
    throw FileError(FileAction::kRead, path_, "became shorter while it was followed", "follow it from its beginning");
  }
}

LiveOutput::LiveOutput(const std::string& path, Overwrite overwrite, const InterruptSignals& signals)
    : path_(is_standard(path) ? "<stdout>" : path), signals_(signals), fd_(opened_for_writing(path, overwrite)) {}

LiveOutput::~LiveOutput() {
  if (fd_ != STDOUT_FILENO) ::close(fd_);
}

void LiveOutput::write(std::string_view text) {
  signals_.wait(fd_, POLLOUT, -1);
  while (!text.empty()) {
    const ssize_t written = ::write(fd_, text.data(), text.size());
    if (written < 0 && errno == EPIPE) throw OutputClosed();
    if (written < 0 && errno != EINTR && errno != EAGAIN) {
      throw FileError(FileAction::kWrite, path_, "cannot write: " + reason());
    }
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
}

}  // namespace strut::cli
