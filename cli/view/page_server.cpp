// SPDX-License-Identifier: MIT
#include "view/page_server.h"

#include <atomic>
#include <chrono>
#include <new>
#include <optional>
#include <random>
#include <thread>
#include <utility>

#include <fmt/core.h>
#include <httplib.h>

#include <strut/core/error.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kTokenBytes = 24;           // 192 bits
constexpr std::size_t kLargestBody = 16U << 20U;  // nothing the page sends comes near [bytes]
constexpr std::size_t kLongestPath = 512;         // a token, a route and an id are far shorter [bytes]
// A connection has its thread for as long as it is kept, and a browser opens six: enough for several pages, and for
// questions that take long beside those that must not wait.
constexpr std::size_t kThreads = 48;
constexpr std::size_t kQuestionsPerConnection = 1000;
constexpr int kKeptConnection = 1;  // for so long nothing may come before it is closed, and stop() waits [s]
constexpr int kForbidden = 403, kNotFound = 404, kTooLarge = 413, kTooLong = 414, kNotJson = 415;

/// The page is one file: it loads nothing, from here or elsewhere, and asks nobody but this server.
constexpr const char* kPagePolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; "
    "worker-src blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string random_token() {
  std::random_device random;  // getrandom or the like on every system strut runs on
  std::string token;
  for (std::size_t i = 0; i < kTokenBytes; ++i) token += fmt::format("{:02x}", random() & 0xffU);
  return token;
}

/// Takes the same time wherever they differ.
bool equal(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  return difference == 0;
}

void refuse(httplib::Response& response, const Refusal& refusal) {
  Json problem{{"message", refusal.message}};
  if (!refusal.hint.empty()) problem["hint"] = refusal.hint;
  const Reply reply = json_reply({{"problem", problem}});
  response.status = refusal.status;
  response.set_content(reply.body, reply.type);
}

void send(const Reply& reply, httplib::Response& response) {
  if (!reply.save_as.empty()) {
    response.set_header("Content-Disposition", "attachment; filename=\"" + reply.save_as + "\"");
  }
  if (!reply.kept) return response.set_content(reply.body, reply.type);
  response.set_content_provider(reply.kept->size(), reply.type,
                                [kept = reply.kept](std::size_t begin, std::size_t count, httplib::DataSink& to) {
                                  return to.write(kept->data() + begin, count);
                                });
}

void answer_with(const PageServer::Answer& answer, const httplib::Request& request, httplib::Response& response) {
  try {
    send(answer(Question(request)), response);
  } catch (const Refusal& refusal) {
    refuse(response, refusal);
  } catch (const Error& error) {
    refuse(response, {400, error.what(), error.hint()});
  } catch (const nlohmann::json::exception& error) {
    refuse(response, {400, std::string("the page sent what is not understood: ") + error.what(), {}});
  } catch (const std::bad_alloc&) {
    refuse(response, {500, "out of memory", {}});
  } catch (const std::exception& error) {
    refuse(response, {500, error.what(), {}});
  }
}

httplib::Server::Handler handler_of(PageServer::Answer answer) {
  return [answer = std::move(answer)](const httplib::Request& request, httplib::Response& response) {
    answer_with(answer, request, response);
  };
}

/// What is said where httplib itself refuses.
void explain(const httplib::Request&, httplib::Response& response) {
  if (!response.body.empty()) return;
  const int status = response.status;
  const char* reason = status == kNotFound   ? "there is nothing at this address"
                       : status == kTooLarge ? "more was sent than is taken (16 MB)"
                       : status == kTooLong  ? "the address is too long"
                                             : "the request is not understood";
  refuse(response, {status, reason, {}});
}

/// Two servers that share a port, which httplib allows, would answer by turns.
void let_nobody_share(socket_t socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

Reply json_reply(const Json& json) {
  return {json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

std::string Question::part(std::size_t n) const {
  return request_.matches[n];
}

std::string Question::parameter(const std::string& name) const {
  if (!request_.has_param(name)) throw Refusal{400, "the parameter '" + name + "' is missing", {}};
  return request_.get_param_value(name);
}

std::string Question::parameter(const std::string& name, const std::string& otherwise) const {
  return request_.has_param(name) ? request_.get_param_value(name) : otherwise;
}

const std::string& Question::body() const {
  return request_.body;
}

struct PageServer::Parts {
  httplib::Server server;
  std::string token = random_token();
  int port = 0;
  std::string address;
  std::thread thread;
  std::atomic<bool> has_ended = false;

  [[nodiscard]] std::string route(const std::string& pattern) const {
    return fmt::format("/{}/api/{}", token, pattern);
  }

  /// Whether a person opens the page: by typing its address, or from anywhere by a link or a file that leads to it.
  [[nodiscard]] bool opens_the_page(const httplib::Request& request) const {
    return request.method == "GET" && request.path == "/" + token + "/" &&
           request.get_header_value("Sec-Fetch-Mode") == "navigate" &&
           request.get_header_value("Sec-Fetch-Dest") == "document";
  }

  /// A name of this server, and not one that another site made lead here (DNS rebinding).
  [[nodiscard]] bool is_own_host(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    return request.get_header_value_count("Host") == 1 &&
           (host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port));
  }

  /// Whether another site's page asks, as browsers tell. Programs that are no browsers tell nothing, and have the
  /// token.
  [[nodiscard]] bool is_from_elsewhere(const httplib::Request& request) const {
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    if (!site.empty() && site != "same-origin" && site != "none" && !opens_the_page(request)) return true;
    return request.has_header("Origin") &&
           request.get_header_value("Origin") != "http://" + request.get_header_value("Host");
  }

  [[nodiscard]] bool has_token(const httplib::Request& request) const {
    const std::string_view path = request.path;
    return equal(path.substr(0, token.size() + 2), "/" + token + "/");
  }

  /// Why a request is not answered. Other sites' forms can post, but not JSON.
  [[nodiscard]] std::optional<Refusal> refusal_of(const httplib::Request& request) const {
    const std::string hint = "open the address that strut view printed";
    if (request.path.size() > kLongestPath) return Refusal{kTooLong, "the address is too long", {}};
    if (!is_own_host(request)) return Refusal{kForbidden, "refused: asked under another name", hint};
    if (is_from_elsewhere(request)) return Refusal{kForbidden, "refused: asked by another site", hint};
    if (!has_token(request)) return Refusal{kForbidden, "refused: no valid token in the address", hint};
    const bool brings_body = request.method == "POST" || request.method == "PUT";
    const std::string type = request.get_header_value("Content-Type");
    if (brings_body && type != "application/json" && !type.starts_with("application/json;")) {
      return Refusal{kNotJson, "refused: what is sent must be application/json", {}};
    }
    return {};
  }
};

PageServer::PageServer(std::string_view page, int port) : parts_(std::make_unique<Parts>()) {
  httplib::Server& server = parts_->server;
  server.set_payload_max_length(kLargestBody);
  server.set_keep_alive_max_count(kQuestionsPerConnection);
  server.set_keep_alive_timeout(kKeptConnection);
  server.set_tcp_nodelay(true);
  server.set_socket_options(let_nobody_share);
  server.set_error_handler(explain);
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"X-Frame-Options", "DENY"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cache-Control", "no-store"}});
  parts_->port =
      port == 0 ? server.bind_to_any_port("127.0.0.1") : (server.bind_to_port("127.0.0.1", port) ? port : -1);
  if (parts_->port <= 0) {
    throw Error(port == 0 ? "no free port on 127.0.0.1" : fmt::format("port {} of 127.0.0.1 cannot be used", port),
                "leave --port out to use any that is free");
  }
  parts_->address = fmt::format("http://127.0.0.1:{}/{}/", parts_->port, parts_->token);
  server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    const std::optional<Refusal> refusal = parts_->refusal_of(request);
    if (!refusal) return httplib::Server::HandlerResponse::Unhandled;
    refuse(response, *refusal);
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get(fmt::format("/{}/", parts_->token), [page](const httplib::Request&, httplib::Response& response) {
    response.set_header("Content-Security-Policy", kPagePolicy);
    response.set_content(page.data(), page.size(), "text/html; charset=utf-8");
  });
}

PageServer::~PageServer() {
  stop();
}

void PageServer::on_get(const std::string& pattern, Answer answer) {
  parts_->server.Get(parts_->route(pattern), handler_of(std::move(answer)));
}

void PageServer::on_post(const std::string& pattern, Answer answer) {
  parts_->server.Post(parts_->route(pattern), handler_of(std::move(answer)));
}

void PageServer::on_put(const std::string& pattern, Answer answer) {
  parts_->server.Put(parts_->route(pattern), handler_of(std::move(answer)));
}

const std::string& PageServer::address() const noexcept {
  return parts_->address;
}

void PageServer::start() {
  parts_->thread = std::thread([this] {
    parts_->server.listen_after_bind();
    parts_->has_ended = true;
  });
  // What does not listen yet cannot be stopped.
  while (!is_running() && !parts_->has_ended) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

bool PageServer::is_running() const {
  return parts_->server.is_running();
}

void PageServer::stop() {
  parts_->server.stop();
  if (parts_->thread.joinable()) parts_->thread.join();
}

}  // namespace strut::cli
