// SPDX-License-Identifier: MIT
#include "bvh_lines.h"

#include <strut/core/error.h>

namespace strut::io::detail {
namespace {

constexpr std::size_t kChunk = 65536;                        // what a pipe holds
constexpr std::size_t kLongestText = std::size_t{1} << 26U;  // a header of a hundred thousand joints is shorter

}  // namespace

bool BvhLines::append_line(std::string& text) {
  const std::size_t length = text.size();
  for (;;) {
    const auto line_end = bytes_.find('\n', begin_);
    if (line_end != bytes_.npos) {
      append(text, line_end + 1);
      return true;
    }
    append(text, bytes_.size());
    if (!refill()) return text.size() > length;
  }
}

void BvhLines::append(std::string& text, std::size_t end) {
  if (text.size() + (end - begin_) > kLongestText) {
    throw FileError(FileAction::kRead, name_, "has a header or a row of more than 64 MB", "is it a BVH file?");
  }
  text.append(bytes_, begin_, end - begin_);
  begin_ = end;
}

bool BvhLines::refill() {
  if (at_end_) return false;
  bytes_.resize(kChunk);
  begin_ = kChunk;  // nothing is left should reading throw
  const std::size_t got = read_(bytes_.data(), kChunk);
  bytes_.resize(got);
  begin_ = 0;
  at_end_ = got == 0;
  return !at_end_;
}

}  // namespace strut::io::detail
