// SPDX-License-Identifier: MIT
// Any text as a pair list: it is read or refused with a ParseError, nothing else. What was read is written again and
// must read as the same pairs.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::vector<strut::PairListEntry> pairs;
  try {
    pairs = strut::parse_pair_list({reinterpret_cast<const char*>(bytes), size}, kPath);
  } catch (const strut::ParseError&) {
    return 0;
  }
  const auto again = strut::parse_pair_list(strut::format_pair_list(pairs, kPath, "heading"), kPath);
  require(again.size() == pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    require(is_same(pairs[i].input, again[i].input) && is_same(pairs[i].output, again[i].output));
    try {
      strut::frames_within(pairs[i].input, 100, kPath);
    } catch (const strut::ParseError&) {
    }
  }
  return 0;
}
