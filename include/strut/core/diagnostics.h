// SPDX-License-Identifier: MIT
// Where the library reports what it recovered from (a unit guessed, an order reduced, a frame count wrong in a header).
// The library only collects; the caller decides what to print. What cannot be recovered from is thrown (core/error.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace strut {

enum class Severity {
  kNote,     ///< an assumption worth knowing, e.g. "lengths read as centimetres"
  kWarning,  ///< the result stands but is probably not what was wanted
};

/// One report.
struct Diagnostic {
  Severity severity = Severity::kNote;
  std::string where;    ///< file, or file:line:column, or a stage's name; may be empty
  std::string message;  ///< one sentence without a final full stop
  std::string hint;     ///< what to do about it; may be empty
};

/// A sink that keeps reports in the order they came. Not thread-safe: give each thread its own and `append` them.
class Diagnostics {
 public:
  void note(std::string where, std::string message, std::string hint = {}) {
    entries_.push_back({Severity::kNote, std::move(where), std::move(message), std::move(hint)});
  }
  void warn(std::string where, std::string message, std::string hint = {}) {
    entries_.push_back({Severity::kWarning, std::move(where), std::move(message), std::move(hint)});
  }
  void append(const Diagnostics& other) {
    entries_.insert(entries_.end(), other.entries_.begin(), other.entries_.end());
  }
  [[nodiscard]] const std::vector<Diagnostic>& entries() const noexcept { return entries_; }

 private:
  std::vector<Diagnostic> entries_;
};

}  // namespace strut
