// SPDX-License-Identifier: MIT
// Any bytes as a BVH file: they are read or refused with a ParseError, nothing else. What was read is written back in
// its own layout and must give the same numbers, and must be readable again in the default layout.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include <strut/core/error.h>
#include <strut/io/bvh.h>

namespace {

// Half a unit of the sixth decimal, and the rounding of large numbers through metres or radians and back.
constexpr double kPrinted = 1e-5;
constexpr double kRounded = 1e-14;
// Larger numbers are read, but a sum of several may pass the largest that is read (1e12).
constexpr double kLargestChecked = 1e6;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Of the file's values and lengths, in its own units or in the smallest ones.
double largest_number(const strut::BvhClip& clip) {
  double largest = 0.0;
  for (const double value : *clip.layout.source_values) largest = std::max(largest, std::abs(value));
  for (const auto& joint : clip.motion.skeleton().joints()) {
    largest = std::max({largest, 1e3 * joint.offset.cwiseAbs().maxCoeff(), 1e3 * joint.end_site.cwiseAbs().maxCoeff()});
  }
  return largest;
}

void check_same_numbers(const strut::BvhClip& clip, strut::PositionChannels positions) {
  const std::string text = strut::format_bvh(clip.motion, clip.layout);
  const strut::BvhClip again = strut::parse_bvh(text, "again", {clip.layout.unit, clip.layout.up, positions});
  const auto &before = *clip.layout.source_values, &after = *again.layout.source_values;
  require(again.layout.header == clip.layout.header && before.size() == after.size());
  const double bound = kPrinted + kRounded * largest_number(clip);
  for (std::size_t i = 0; i < before.size(); ++i) require(std::abs(before[i] - after[i]) <= bound);
}

void check_default_layout(const strut::BvhClip& clip) {
  std::string text;
  try {
    text = strut::format_bvh(clip.motion, strut::default_layout(clip.motion.skeleton()));
  } catch (const strut::InvalidArgument&) {
    return;  // a name that cannot stand in a file, e.g. with a brace in it
  }
  const strut::BvhClip again = strut::parse_bvh(text, "default");
  require(again.motion.num_frames() == clip.motion.num_frames());
  require(strut::describe_mismatch(clip.motion.skeleton(), again.motion.skeleton()).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const auto positions =
      size % 2 == 0 ? strut::PositionChannels::kReplaceOffset : strut::PositionChannels::kAddToOffset;
  std::optional<strut::BvhClip> clip;
  strut::Diagnostics diagnostics;
  try {
    clip = strut::parse_bvh(text, "fuzz", {{}, {}, positions}, &diagnostics);
  } catch (const strut::ParseError&) {
    return 0;
  }
  if (largest_number(*clip) > kLargestChecked) return 0;
  check_same_numbers(*clip, positions);
  check_default_layout(*clip);
  return 0;
}
