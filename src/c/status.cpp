// SPDX-License-Identifier: MIT
// Statuses, the last error of every thread, versions.
#include "c/status.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string_view>

#include <strut/core/version.h>

namespace strut::c {
namespace {

constexpr std::size_t kLongestError = 511;  // bytes; the header promises it

/// Needs no memory of its own, so that running out of it can be told.
thread_local std::array<char, kLongestError + 1> last_error{};

bool continues_a_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

/// Keeps `text` up to its first zero byte, cut between characters of UTF-8.
strut_status fail(strut_status status, const char* text) noexcept {
  std::string_view kept(text);
  if (kept.size() > kLongestError) {
    std::size_t end = kLongestError;
    while (end > 0 && continues_a_character(kept[end])) --end;
    kept = kept.substr(0, end);
  }
  std::copy(kept.begin(), kept.end(), last_error.begin());
  last_error.at(kept.size()) = '\0';
  return status;
}

}  // namespace

strut_status report_exception() noexcept {
  try {
    throw;
  } catch (const InvalidArgument& error) {
    return fail(STRUT_INVALID_ARGUMENT, error.what());
  } catch (const FileError& error) {
    return fail(STRUT_CANNOT_READ, error.what());
  } catch (const ParseError& error) {
    return fail(STRUT_BAD_FILE, error.what());
  } catch (const VersionError& error) {
    return fail(STRUT_UNSUPPORTED_VERSION, error.what());
  } catch (const SkeletonMismatch& error) {
    return fail(STRUT_SKELETON_MISMATCH, error.what());
  } catch (const std::bad_alloc&) {
    return fail(STRUT_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return fail(STRUT_INTERNAL_ERROR, error.what());
  } catch (...) {
    return fail(STRUT_INTERNAL_ERROR, "something unknown was thrown");
  }
}

}  // namespace strut::c

uint32_t strut_abi_version(void) {
  return STRUT_ABI_VERSION;
}

const char* strut_version(void) {
  return strut::version();
}

const char* strut_last_error(void) {
  return strut::c::last_error.data();
}

const char* strut_status_name(int status) {
  switch (status) {
    case STRUT_OK:
      return "STRUT_OK";
    case STRUT_NO_OUTPUT:
      return "STRUT_NO_OUTPUT";
    case STRUT_INVALID_ARGUMENT:
      return "STRUT_INVALID_ARGUMENT";
    case STRUT_CANNOT_READ:
      return "STRUT_CANNOT_READ";
    case STRUT_BAD_FILE:
      return "STRUT_BAD_FILE";
    case STRUT_UNSUPPORTED_VERSION:
      return "STRUT_UNSUPPORTED_VERSION";
    case STRUT_SKELETON_MISMATCH:
      return "STRUT_SKELETON_MISMATCH";
    case STRUT_OUT_OF_MEMORY:
      return "STRUT_OUT_OF_MEMORY";
    case STRUT_INTERNAL_ERROR:
      return "STRUT_INTERNAL_ERROR";
  }
  return "unknown status";
}
