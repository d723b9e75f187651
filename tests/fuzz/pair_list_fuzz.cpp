// SPDX-License-Identifier: MIT
// Any text as a pair list: it is read or refused with a ParseError, nothing else. What was read is written again and
// must read as the same pairs with the same comments.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <strut/core/error.h>
#include <strut/io/pair_list.h>

namespace {

constexpr const char* kPath = "/folder/pairs.toml";

void require(bool holds) {
  if (!holds) std::abort();
}

bool is_same(const strut::PairedClip& a, const strut::PairedClip& b) {
  // A name that leads out of the folder and back may be written more shortly.
  return std::filesystem::path(a.path).lexically_normal() == std::filesystem::path(b.path).lexically_normal() &&
         a.frames == b.frames;
}

bool are_same(const std::vector<strut::PairListEntry>& a, const std::vector<strut::PairListEntry>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return is_same(x.input, y.input) && is_same(x.output, y.output) && x.comment == y.comment;
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  strut::PairList list;
  try {
    list = strut::parse_annotated_pair_list({reinterpret_cast<const char*>(bytes), size}, kPath);
  } catch (const strut::ParseError&) {
    return 0;
  }
  const auto again = strut::parse_annotated_pair_list(strut::format_pair_list(list, kPath), kPath);
  require(are_same(list.pairs, again.pairs) && are_same(list.rejected, again.rejected));
  require(list.heading == again.heading && list.ending == again.ending);
  for (const strut::PairListEntry& pair : list.pairs) {
    try {
      strut::frames_within(pair.input, 100, kPath);
    } catch (const strut::ParseError&) {
    }
  }
  return 0;
}
