// SPDX-License-Identifier: MIT
// The boundary itself: what is thrown on the inside becomes a status and a line of text on the outside.
#pragma once

#include <exception>
#include <string>

#include <strut/c/strut.h>
#include <strut/core/error.h>

namespace strut::c {

/// The status of the exception that is being handled; its text becomes this thread's last error. Never throws: a text
/// that does not fit is cut.
strut_status report_exception() noexcept;

/// Runs what a C function does: `action` returns a status or throws.
template <typename Action>
strut_status guarded(const Action& action) noexcept {
  try {
    return action();
  } catch (...) {
    return report_exception();
  }
}

/// Throws InvalidArgument if a pointer that a C function was given is NULL.
template <typename T>
T& required(const char* name, T* pointer) {
  if (pointer == nullptr) throw InvalidArgument(name, "a pointer", "NULL");
  return *pointer;
}

}  // namespace strut::c
