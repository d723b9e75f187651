// SPDX-License-Identifier: MIT
// Opens an address that is a secret in the person's browser. The arguments of a program can be read by everybody on the
// machine, so the browser is given a file that only this person can read, and that leads on to the address.
#pragma once

#include <memory>
#include <string>
#include <sys/types.h>

namespace strut::cli {

class BrowserPage {
 public:
  /// Starts the system's opener (xdg-open, on macOS open) and does not wait for it. Throws Error if there is no screen,
  /// no opener, or the file cannot be made.
  explicit BrowserPage(const std::string& address);
  /// Removes the file.
  ~BrowserPage();
  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

  /// True once, after the opener has ended and said that it found no browser.
  bool has_failed();

 private:
  class PrivateFile;
  std::unique_ptr<PrivateFile> file_;
  pid_t opener_ = -1;  ///< -1: has ended
};

}  // namespace strut::cli
