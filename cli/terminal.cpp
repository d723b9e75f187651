// SPDX-License-Identifier: MIT
#include "terminal.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>
#include <unistd.h>
#include <vector>

#include <fmt/core.h>

namespace strut::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRedrawInterval{50};

/// What is said of one or several places.
struct Remark {
  Diagnostic what;
  std::set<std::string> others;  ///< further places
};

bool says_the_same(const Diagnostic& a, const Diagnostic& b) {
  return a.severity == b.severity && a.message == b.message && a.hint == b.hint;
}

std::vector<Remark> remarks_of(const Diagnostics& diagnostics) {
  std::vector<Remark> remarks;
  for (const Diagnostic& entry : diagnostics.entries()) {
    const auto same = std::find_if(remarks.begin(), remarks.end(),
                                   [&](const Remark& remark) { return says_the_same(remark.what, entry); });
    if (same == remarks.end()) {
      remarks.push_back({entry, {}});
    } else if (same->what.where != entry.where) {
      same->others.insert(entry.where);
    }
  }
  return remarks;
}

}  // namespace

void say(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

void print_diagnostics(const Diagnostics& diagnostics) {
  for (const auto& [what, others] : remarks_of(diagnostics)) {
    std::string where = what.where.empty() ? "strut" : what.where;
    if (others.size() == 1) where += " and " + *others.begin();
    if (others.size() > 1) where += fmt::format(" and {} others", others.size());
    const char* kind = what.severity == Severity::kWarning ? "warning" : "note";
    say(fmt::format("{}: {}: {}\n", where, kind, what.message));
    if (!what.hint.empty()) say(fmt::format("hint: {}\n", what.hint));
  }
}

PrintedDiagnostics::~PrintedDiagnostics() {
  Diagnostics told;
  for (const Diagnostic& entry : entries()) {
    if (entry.severity == Severity::kWarning) told.warn(entry.where, entry.message, entry.hint);
    if (entry.severity == Severity::kNote && std::uncaught_exceptions() == 0)
      told.note(entry.where, entry.message, entry.hint);
  }
  print_diagnostics(told);
}

ProgressLine::ProgressLine(std::string label) : label_(std::move(label)), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (drawn_) say("\r\x1b[K");
}

void ProgressLine::update(const std::string& step, int done, int total) {
  const auto now = std::chrono::steady_clock::now();
  if (!is_terminal_ || total <= 0 || (drawn_ && done < total && now - last_ < kRedrawInterval)) return;
  last_ = now;
  drawn_ = true;
  const int filled = kBarWidth * done / total;
  say(fmt::format("\r\x1b[K{} [{:#<{}}{:.<{}}] {}/{} {}", label_, "", filled, "", kBarWidth - filled, done, total,
                  step));
  std::fflush(stderr);
}

}  // namespace strut::cli
