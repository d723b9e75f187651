// SPDX-License-Identifier: MIT
// Comments of a pair list in TOML, which a TOML parser skips: where each stands, and to which pair it belongs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace strut::io::detail {

/// The lines of a pair, from 1, both included: from its [[pair]] to the last of its values.
struct LineSpan {
  std::size_t first = 0, last = 0;
};

/// A list's comments without their '#', lines apart by "\n", without blank lines at the ends.
struct PairListComments {
  std::string heading;                ///< what a blank line parts from the first pair
  std::vector<std::string> of_pairs;  ///< what stands above and inside each pair
  std::string ending;                 ///< what stands after the last
};

/// The comments of `text`, which is valid TOML and holds `pairs` in this order. Every comment is in exactly one place.
PairListComments comments_of(std::string_view text, const std::vector<LineSpan>& pairs);

}  // namespace strut::io::detail
