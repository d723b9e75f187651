// SPDX-License-Identifier: MIT
// Serves one page and the answers to its questions, to one browser on this machine: bound to 127.0.0.1, below an
// address that holds a token nobody can guess, and to no page but its own. Knows nothing of motion. What is refused and
// why: docs/viewer.md.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace httplib {
struct Request;
}

namespace strut::cli {

inline constexpr const char* kBytes = "application/octet-stream";

/// What is answered.
struct Reply {
  std::string body = {};
  std::string type = "application/json";
  std::string save_as = {};                      ///< a file's name: the browser saves the body instead of showing it
  std::shared_ptr<const std::string> kept = {};  ///< instead of `body`: sent without a copy
};

/// `json` as an answer; what in it is no UTF-8 (a file's name may be any bytes) is replaced.
Reply json_reply(const nlohmann::ordered_json& json);

/// What the page asks.
class Question {
 public:
  explicit Question(const httplib::Request& request) : request_(request) {}
  /// What the address's n-th "([^/]+)" matched, from 1.
  [[nodiscard]] std::string part(std::size_t n) const;
  /// A parameter of the address. Throws Refusal if it is missing.
  [[nodiscard]] std::string parameter(const std::string& name) const;
  [[nodiscard]] std::string parameter(const std::string& name, const std::string& otherwise) const;
  [[nodiscard]] const std::string& body() const;

 private:
  const httplib::Request& request_;
};

/// A question that cannot be answered; what the library throws is turned into the same. The page shows the message.
struct Refusal {
  int status = 400;  ///< of HTTP
  std::string message, hint;
};

class PageServer {
 public:
  using Answer = std::function<Reply(const Question&)>;

  /// Binds to `port` of 127.0.0.1, 0: any that is free. Throws Error if it cannot.
  PageServer(std::string_view page, int port);
  /// As stop().
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// What is answered to `pattern`, a regular expression below "ADDRESS/api/". Answers run in several threads at once.
  /// Bodies of POST and PUT are JSON.
  void on_get(const std::string& pattern, Answer answer);
  void on_post(const std::string& pattern, Answer answer);
  void on_put(const std::string& pattern, Answer answer);

  /// "http://127.0.0.1:PORT/TOKEN/"
  [[nodiscard]] const std::string& address() const noexcept;
  /// Serves, in threads of its own.
  void start();
  [[nodiscard]] bool is_running() const;
  /// Refuses what comes and waits for answers that are under way.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace strut::cli
