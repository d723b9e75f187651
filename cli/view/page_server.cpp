// SPDX-License-Identifier: MIT
#include "view/page_server.h"

#include <array>
#include <random>

#include <fmt/core.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include <strut/core/error.h>

namespace strut::cli {
namespace {

constexpr std::size_t kTokenBytes = 24;           // 192 bits
constexpr std::size_t kLargestBody = 16U << 20U;  // nothing the page sends comes near [bytes]
constexpr int kForbidden = 403;

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

std::string as_json(const Refusal& refusal) {
  nlohmann::ordered_json problem{{"message", refusal.message}};
  if (!refusal.hint.empty()) problem["hint"] = refusal.hint;
  return nlohmann::ordered_json{{"problem", problem}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void refuse(httplib::Response& response, const Refusal& refusal) {
  response.status = refusal.status;
  response.set_content(as_json(refusal), "application/json");
}

void answer_with(const PageServer::Answer& answer, const httplib::Request& request, httplib::Response& response) {
  try {
    const Reply reply = answer(Question(request));
    if (!reply.save_as.empty()) {
      response.set_header("Content-Disposition", "attachment; filename=\"" + reply.save_as + "\"");
    }
    response.set_content(reply.body, reply.type);
  } catch (const Refusal& refusal) {
    refuse(response, refusal);
  } catch (const Error& error) {
    refuse(response, {400, error.what(), error.hint()});
  } catch (const nlohmann::json::exception& error) {
    refuse(response, {400, std::string("the page sent what is not understood: ") + error.what(), {}});
  } catch (const std::exception& error) {
    refuse(response, {500, error.what(), {}});
  }
}

}  // namespace

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
  std::string origin, address;

  /// Why a request is not answered; empty if it is.
  [[nodiscard]] std::string_view reason_to_refuse(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    if (host != fmt::format("127.0.0.1:{}", port) && host != fmt::format("localhost:{}", port)) return "another host";
    const std::string from = request.get_header_value("Origin");
    if (!from.empty() && from != origin && from != fmt::format("http://localhost:{}", port)) return "another origin";
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    if (site == "cross-site" && request.method != "GET") return "another site";
    const auto end = request.path.find('/', 1);
    const std::string_view first = std::string_view(request.path).substr(1, end == std::string::npos ? end : end - 1);
    if (!equal(first, token)) return "no valid token";
    return {};
  }
};

PageServer::PageServer(std::string_view page, int port) : parts_(std::make_unique<Parts>()) {
  httplib::Server& server = parts_->server;
  server.set_payload_max_length(kLargestBody);
  server.set_keep_alive_max_count(1000);
  server.set_tcp_nodelay(true);
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
  parts_->origin = fmt::format("http://127.0.0.1:{}", parts_->port);
  parts_->address = fmt::format("{}/{}/", parts_->origin, parts_->token);
  server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    const std::string_view reason = parts_->reason_to_refuse(request);
    if (reason.empty()) return httplib::Server::HandlerResponse::Unhandled;
    refuse(response, {kForbidden, fmt::format("refused: {}", reason), "open the address that strut view printed"});
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get(fmt::format("/{}/", parts_->token), [page](const httplib::Request&, httplib::Response& response) {
    response.set_content(page.data(), page.size(), "text/html; charset=utf-8");
  });
}

PageServer::~PageServer() = default;

void PageServer::on_get(const std::string& pattern, Answer answer) {
  parts_->server.Get(fmt::format("/{}/api/{}", parts_->token, pattern),
                     [answer = std::move(answer)](const httplib::Request& request, httplib::Response& response) {
                       answer_with(answer, request, response);
                     });
}

void PageServer::on_post(const std::string& pattern, Answer answer) {
  parts_->server.Post(fmt::format("/{}/api/{}", parts_->token, pattern),
                      [answer = std::move(answer)](const httplib::Request& request, httplib::Response& response) {
                        answer_with(answer, request, response);
                      });
}

void PageServer::on_put(const std::string& pattern, Answer answer) {
  parts_->server.Put(fmt::format("/{}/api/{}", parts_->token, pattern),
                     [answer = std::move(answer)](const httplib::Request& request, httplib::Response& response) {
                       answer_with(answer, request, response);
                     });
}

void PageServer::on_delete(const std::string& pattern, Answer answer) {
  parts_->server.Delete(fmt::format("/{}/api/{}", parts_->token, pattern),
                        [answer = std::move(answer)](const httplib::Request& request, httplib::Response& response) {
                          answer_with(answer, request, response);
                        });
}

const std::string& PageServer::address() const noexcept {
  return parts_->address;
}

void PageServer::run() {
  parts_->server.listen_after_bind();
}

void PageServer::stop() {
  parts_->server.stop();
}

}  // namespace strut::cli
