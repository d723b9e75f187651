// SPDX-License-Identifier: MIT
#include "view_session.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <httplib.h>

namespace strut::test {
namespace {

using Json = nlohmann::json;

constexpr int kPatience = 60;                // before an answer is taken not to come [s]; sanitized programs are slow
constexpr std::uint16_t kNoNumber = 0xffff;  // as u16

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string from_problem(const std::string& body, const char* name) {
  const Json json = Json::parse(body, nullptr, false);
  if (!json.is_object() || !json.contains("problem")) return {};
  return json["problem"].value(name, "");
}

template <typename Number>
std::vector<Number> numbers_at(const std::string& bytes, std::size_t start, std::size_t count) {
  std::vector<Number> numbers(count);
  if (start > bytes.size() || count * sizeof(Number) > bytes.size() - start) {
    ADD_FAILURE() << "an array reaches beyond the container's end";
    return {};
  }
  std::memcpy(numbers.data(), bytes.data() + start, count * sizeof(Number));
  return numbers;
}

std::vector<float> array_at(const std::string& bytes, std::size_t base, const Json& entry) {
  const std::size_t start = base + entry.at("start").get<std::size_t>(), count = entry.at("count").get<std::size_t>();
  if (entry.at("type") == "f32") return numbers_at<float>(bytes, start, count);
  const float scale = entry.value("scale", 1.0F), offset = entry.value("offset", 0.0F);
  std::vector<float> values;
  for (const std::uint16_t stored : numbers_at<std::uint16_t>(bytes, start, count)) {
    values.push_back(stored == kNoNumber ? std::numeric_limits<float>::quiet_NaN()
                                         : offset + scale * static_cast<float>(stored));
  }
  return values;
}

}  // namespace

Json ViewAnswer::json() const {
  Json value = Json::parse(body, nullptr, false);
  if (!value.is_discarded()) return value;
  ADD_FAILURE() << "no JSON, status " << status << ": " << body.substr(0, 200);
  return nullptr;
}

std::string ViewAnswer::problem() const {
  return from_problem(body, "message");
}

std::string ViewAnswer::hint() const {
  return from_problem(body, "hint");
}

ViewContainer read_container(const std::string& bytes) {
  std::uint32_t length = 0;
  if (bytes.size() >= sizeof length) std::memcpy(&length, bytes.data(), sizeof length);
  const std::size_t base = sizeof length + length;
  ViewContainer container;
  if (length == 0 || base > bytes.size()) {
    ADD_FAILURE() << "no container: " << bytes.substr(0, 200);
    return container;
  }
  container.header = Json::parse(bytes.substr(sizeof length, length));
  for (const Json& entry : container.header.at("arrays")) {
    container.arrays[entry.at("name")] = array_at(bytes, base, entry);
  }
  return container;
}

ViewSession::ViewSession(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "view");
  arguments.emplace_back("--no-browser");
  *this = ViewSession(STRUT_PROGRAM, arguments);
}

ViewSession::ViewSession(const std::string& program, const std::vector<std::string>& arguments)
    : program_(std::make_unique<LiveProgram>(program, arguments)) {
  const std::string kStart = "http://127.0.0.1:", line = program_->read_line();
  const auto begin = line.find(kStart), end = line.find_first_of(" \n", begin);
  if (begin == std::string::npos || end == std::string::npos) {
    ADD_FAILURE() << "no address: " << line;
    return;
  }
  address_ = line.substr(begin, end - begin);
  const auto slash = address_.find('/', kStart.size());
  port_ = std::stoi(address_.substr(kStart.size()));
  token_ = address_.substr(slash + 1, address_.size() - slash - 2);
}

ViewAnswer ViewSession::request(const std::string& method, const std::string& target, const Headers& headers,
                                const std::string& body, const std::string& type) const {
  httplib::Client client("127.0.0.1", port_);
  client.set_read_timeout(kPatience);
  httplib::Request request;
  request.method = method;
  request.path = target;
  for (const auto& [name, value] : headers) request.headers.emplace(name, value);
  request.body = body;
  if (!type.empty()) request.headers.emplace("Content-Type", type);
  const httplib::Result result = client.send(request);
  if (!result) return {};
  ViewAnswer answer{result->status, result->body, {}};
  for (const auto& [name, value] : result->headers) answer.headers[lower(name)] = value;
  return answer;
}

ViewAnswer ViewSession::get(const std::string& path, const Headers& headers) const {
  return request("GET", "/" + token_ + "/api/" + path, headers);
}

ViewAnswer ViewSession::post(const std::string& path, const Json& body, const Headers& headers) const {
  return request("POST", "/" + token_ + "/api/" + path, headers, body.dump(), "application/json");
}

ViewAnswer ViewSession::put(const std::string& path, const Json& body, const Headers& headers) const {
  return request("PUT", "/" + token_ + "/api/" + path, headers, body.dump(), "application/json");
}

Json ViewSession::json(const std::string& path) const {
  const ViewAnswer answer = get(path);
  EXPECT_EQ(answer.status, 200) << path << ": " << answer.body.substr(0, 200);
  return answer.json();
}

ViewContainer ViewSession::container(const std::string& path) const {
  const ViewAnswer answer = get(path);
  EXPECT_EQ(answer.status, 200) << path << ": " << answer.body.substr(0, 200);
  return answer.status == 200 ? read_container(answer.body) : ViewContainer{};
}

void ViewSession::kill() {
  program_->send(SIGKILL);
  program_->exit_code();
}

int ViewSession::end_with(int signal) {
  program_->send(signal);
  return program_->exit_code();
}

}  // namespace strut::test
