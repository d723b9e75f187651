// SPDX-License-Identifier: MIT
// Whole-file reading and atomic writing with POSIX calls. O_TMPFILE gives a file without a name, so even SIGKILL leaves
// nothing behind; file systems without it fall back to a named temporary that is removed on failure.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

#include <strut/core/error.h>
#include <strut/core/file.h>

namespace strut {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

 private:
  int fd_;
};

/// Removes a named temporary file unless it was released (renamed into place).
class TemporaryName {
 public:
  explicit TemporaryName(std::string path) : path_(std::move(path)) {}
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;
  ~TemporaryName() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  [[nodiscard]] const std::string& path() const { return path_; }
  void release() { path_.clear(); }

 private:
  std::string path_;
};

std::string reason() {
  return std::strerror(errno);
}

std::string folder_of(const std::string& path) {
  const auto slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

void write_all(int fd, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw FileError(FileAction::kWrite, path, "cannot write: " + reason());
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

[[noreturn]] void refuse_existing(const std::string& path) {
  throw FileError(FileAction::kWrite, path, "the file already exists", "use --force to overwrite it");
}

bool is_regular_or_missing(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return true;
  if (S_ISDIR(status.st_mode)) throw FileError(FileAction::kWrite, path, "is a folder, not a file");
  return S_ISREG(status.st_mode);
}

/// Gives the unnamed file `fd` a name beside the target; empty where /proc, which it takes, is missing.
std::string link_beside(int fd, const std::string& path) {
  const std::string source = "/proc/self/fd/" + std::to_string(fd);
  for (unsigned attempt = 0;; ++attempt) {
    std::string name = path + ".tmp" + std::to_string(::getpid()) + "." + std::to_string(attempt);
    if (::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) return name;
    if (errno == ENOENT) return {};
    if (errno != EEXIST || attempt > 100) throw FileError(FileAction::kWrite, path, "cannot write: " + reason());
  }
}

void move_into_place(TemporaryName& temporary, const std::string& path, Overwrite overwrite) {
  if (overwrite == Overwrite::kAllow) {
    if (::rename(temporary.path().c_str(), path.c_str()) != 0)
      throw FileError(FileAction::kWrite, path, "cannot write: " + reason());
    temporary.release();
    return;
  }
  // link() refuses an existing target even if it appeared after our check; the temporary name then goes by itself.
  if (::link(temporary.path().c_str(), path.c_str()) != 0) {
    if (errno == EEXIST) refuse_existing(path);
    throw FileError(FileAction::kWrite, path, "cannot write: " + reason());
  }
}

void finish(int fd, const std::string& path) {
  // Without this, some file systems report a full disk only after the rename.
  if (::fsync(fd) != 0 && errno != EINVAL && errno != EROFS)
    throw FileError(FileAction::kWrite, path, "cannot write: " + reason());
}

/// Writes a file that has no name until it is complete, then its temporary one, which is returned; empty where the file
/// system has no such files.
std::string write_unnamed(const std::string& path, std::string_view bytes) {
  const Descriptor file(::open(folder_of(path).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  if (!file.is_open()) return {};
  write_all(file.get(), bytes, path);
  finish(file.get(), path);
  return link_beside(file.get(), path);
}

void write_named(const std::string& path, std::string_view bytes, Overwrite overwrite) {
  std::string name = path + ".tmpXXXXXX";
  const Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
  if (!file.is_open()) throw FileError(FileAction::kWrite, path, "cannot write: " + reason());
  TemporaryName temporary(name);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(file.get(), 0666 & ~mask);
  write_all(file.get(), bytes, path);
  finish(file.get(), path);
  move_into_place(temporary, path, overwrite);
}

/// What a link leads to, so that writing replaces the file and not the link; `path` itself if it is no link.
std::string resolved(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_symlink(path, failed)) return path;
  const std::filesystem::path target = std::filesystem::canonical(path, failed);
  return failed ? path : target.string();
}

}  // namespace

std::string read_file(const std::string& path) {
  if (path.empty()) throw FileError(FileAction::kRead, "''", "is no file name");
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) throw FileError(FileAction::kRead, path, "cannot open: " + reason());
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) throw FileError(FileAction::kRead, path, "cannot read: " + reason());
  if (S_ISDIR(status.st_mode)) throw FileError(FileAction::kRead, path, "is a folder, not a file");
  std::string bytes;
  std::size_t used = 0;
  bytes.resize(S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) + 1 : 65536);
  for (;;) {
    if (used == bytes.size()) bytes.resize(2 * bytes.size());
    const ssize_t got = ::read(file.get(), bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(FileAction::kRead, path, "cannot read: " + reason());
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
  }
  bytes.resize(used);
  return bytes;
}

void check_writable(const std::string& path, Overwrite overwrite) {
  if (path.empty()) throw FileError(FileAction::kWrite, "''", "is no file name");
  struct stat status {};
  if (!is_regular_or_missing(path)) return;
  if (overwrite == Overwrite::kRefuse && ::stat(path.c_str(), &status) == 0) refuse_existing(path);
  if (::access(folder_of(path).c_str(), F_OK) != 0)
    throw FileError(FileAction::kWrite, path, "there is no folder '" + folder_of(path) + "' to write it to");
  if (::access(folder_of(path).c_str(), W_OK | X_OK) != 0)
    throw FileError(FileAction::kWrite, path, "cannot write: " + reason());
}

void write_file(const std::string& path, std::string_view bytes, Overwrite overwrite) {
  if (!is_regular_or_missing(path)) {
    const Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!device.is_open()) throw FileError(FileAction::kWrite, path, "cannot open: " + reason());
    write_all(device.get(), bytes, path);
    return;
  }
  check_writable(path, overwrite);
  const std::string target = resolved(path);
  if (std::string name = write_unnamed(target, bytes); !name.empty()) {
    TemporaryName temporary(std::move(name));
    move_into_place(temporary, target, overwrite);
    return;
  }
  write_named(target, bytes, overwrite);
}

}  // namespace strut
