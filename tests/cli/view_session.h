// SPDX-License-Identifier: MIT
// strut view as a page meets it: the built program runs, says its address, is asked over HTTP, and may be killed.
#pragma once

#include "support/live_program.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace strut::test {

/// What the server said; status 0 if it said nothing.
struct ViewAnswer {
  int status = 0;
  std::string body;
  std::map<std::string, std::string> headers;  ///< names in lower case

  /// The body as JSON; null, and a failure of the test, if it is none.
  [[nodiscard]] nlohmann::json json() const;
  /// {"problem": {"message"}}; empty if there is none.
  [[nodiscard]] std::string problem() const;
  [[nodiscard]] std::string hint() const;
};

/// A container (cli/view/container.h) read back; numbers stored as u16 are scaled.
struct ViewContainer {
  nlohmann::json header;
  std::map<std::string, std::vector<float>> arrays;
};

/// Reads a container. A failure of the test if the bytes are none.
ViewContainer read_container(const std::string& bytes);

class ViewSession {
 public:
  using Headers = std::multimap<std::string, std::string>;

  /// Starts "strut view ARGUMENTS --no-browser" and waits for its address.
  explicit ViewSession(std::vector<std::string> arguments);
  /// Starts `program` so, which must print the address first (a browser may be opened).
  ViewSession(const std::string& program, const std::vector<std::string>& arguments);

  /// "http://127.0.0.1:PORT/TOKEN/"
  [[nodiscard]] const std::string& address() const { return address_; }
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] const std::string& token() const { return token_; }

  /// Asks "ADDRESS/api/PATH", each time over a connection of its own; may be called from several threads at once.
  /// `body` is sent as application/json.
  [[nodiscard]] ViewAnswer get(const std::string& path, const Headers& headers = {}) const;
  [[nodiscard]] ViewAnswer post(const std::string& path, const nlohmann::json& body, const Headers& headers = {}) const;
  [[nodiscard]] ViewAnswer put(const std::string& path, const nlohmann::json& body, const Headers& headers = {}) const;
  /// The JSON or the container that get() is answered. A failure of the test if it is refused.
  [[nodiscard]] nlohmann::json json(const std::string& path) const;
  [[nodiscard]] ViewContainer container(const std::string& path) const;

  /// Any request at all: `target` is the whole path from "/", `body` goes as `type` if that is not empty.
  [[nodiscard]] ViewAnswer request(const std::string& method, const std::string& target, const Headers& headers = {},
                                   const std::string& body = {}, const std::string& type = {}) const;

  /// Ends it as a crash does, at once. Nothing is asked after that.
  void kill();
  /// Sends `signal` and waits for the end; its exit code.
  int end_with(int signal);
  /// The running program, for what it printed and took.
  [[nodiscard]] LiveProgram& program() { return *program_; }

 private:
  std::unique_ptr<LiveProgram> program_;
  std::string address_, token_;
  int port_ = 0;
};

}  // namespace strut::test
