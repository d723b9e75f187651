// SPDX-License-Identifier: MIT
#include "terminal.h"

#include <cstdio>
#include <set>
#include <unistd.h>

#include <fmt/core.h>

namespace strut::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRedrawInterval{50};

}  // namespace

void print_diagnostics(const Diagnostics& diagnostics) {
  std::set<std::string> seen;
  for (const Diagnostic& entry : diagnostics.entries()) {
    const char* kind = entry.severity == Severity::kWarning ? "warning" : "note";
    std::string text = entry.where.empty() ? "strut" : entry.where;
    text += fmt::format(": {}: {}\n", kind, entry.message);
    if (!entry.hint.empty()) text += fmt::format("hint: {}\n", entry.hint);
    if (seen.insert(text).second) fmt::print(stderr, "{}", text);
  }
}

ProgressLine::ProgressLine(std::string label) : label_(std::move(label)), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressLine::update(const std::string& step, int done, int total) {
  const auto now = std::chrono::steady_clock::now();
  if (!is_terminal_ || total <= 0 || (drawn_ && done < total && now - last_ < kRedrawInterval)) return;
  last_ = now;
  drawn_ = true;
  const int filled = kBarWidth * done / total;
  fmt::print(stderr, "\r\x1b[K{} [{:#<{}}{:.<{}}] {}/{} {}", label_, "", filled, "", kBarWidth - filled, done, total,
             step);
  std::fflush(stderr);
}

}  // namespace strut::cli
