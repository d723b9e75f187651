// SPDX-License-Identifier: MIT
#include "view/open_browser.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/core.h>

#include <strut/core/error.h>

extern char** environ;  // NOLINT: POSIX declares it in no header

namespace strut::cli {
namespace {

namespace fs = std::filesystem;

#ifdef __APPLE__
constexpr const char* kOpener = "open";
#else
constexpr const char* kOpener = "xdg-open";
#endif

std::string variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing changes the environment
  return value == nullptr ? "" : value;
}

/// Without a screen xdg-open starts a browser inside the terminal.
bool has_screen() {
#ifdef __APPLE__
  return true;
#else
  return !variable("DISPLAY").empty() || !variable("WAYLAND_DISPLAY").empty() || !variable("BROWSER").empty();
#endif
}

std::string page_leading_to(const std::string& address) {
  return fmt::format(
      "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<title>strut view</title>\n"
      "<meta http-equiv=\"refresh\" content=\"0; url={0}\">\n<a href=\"{0}\">strut view</a>\n",
      address);
}

/// The person's own folder for what lives as long as the session; where there is none, the one for temporary files.
fs::path folder_for_private_files() {
  std::error_code missing;
  const fs::path own = variable("XDG_RUNTIME_DIR");
  return !own.empty() && fs::is_directory(own, missing) ? own : fs::temp_directory_path();
}

pid_t spawned(const char* program, const std::string& argument) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t pipe;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &pipe);
  // A group of its own: Ctrl+C here must not end the browser.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  std::string name = program, word = argument;
  char* words[] = {name.data(), word.data(), nullptr};
  pid_t process = -1;
  const int error = ::posix_spawnp(&process, program, &actions, &attributes, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw Error(fmt::format("{} cannot be started", program));
  return process;
}

}  // namespace

/// A file in a folder that only this person can enter.
class BrowserPage::PrivateFile {
 public:
  explicit PrivateFile(const std::string& text) {
    folder_ = (folder_for_private_files() / "strut-view-XXXXXX").string();
    if (::mkdtemp(folder_.data()) == nullptr) throw Error("no private folder can be made at " + folder_);
    const int file = ::open(path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    const bool is_written = file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    if (file >= 0) ::close(file);
    if (is_written) return;
    remove();
    throw Error(path() + " cannot be written");
  }
  ~PrivateFile() { remove(); }
  PrivateFile(const PrivateFile&) = delete;
  PrivateFile& operator=(const PrivateFile&) = delete;

  [[nodiscard]] std::string path() const { return folder_ + "/view.html"; }

 private:
  void remove() const {
    ::unlink(path().c_str());
    ::rmdir(folder_.c_str());
  }
  std::string folder_;
};

BrowserPage::BrowserPage(const std::string& address) {
  if (!has_screen()) throw Error("there is no screen");
  file_ = std::make_unique<PrivateFile>(page_leading_to(address));
  opener_ = spawned(kOpener, file_->path());
}

BrowserPage::~BrowserPage() = default;

bool BrowserPage::has_failed() {
  int status = 0;
  if (opener_ < 0 || ::waitpid(opener_, &status, WNOHANG) != opener_) return false;
  opener_ = -1;
  return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

}  // namespace strut::cli
