// SPDX-License-Identifier: MIT
// What strut align tells: in words for a person, as JSON for a program, and the correspondence itself as tables.
#pragma once

#include "alignment.h"

#include <string>

#include <nlohmann/json.hpp>

namespace strut::cli {

/// A few lines; `with_rounds`: also what the method minimizes, round by round.
std::string alignment_in_words(const Alignment& alignment, bool with_rounds);

/// The clip whose frames are given places, as the first line of a report.
std::string clip_in_words(const char* role, const AlignClip& clip);

/// The same figures, times in seconds.
nlohmann::ordered_json alignment_as_json(const Alignment& alignment);
nlohmann::ordered_json clip_as_json(const AlignClip& clip);

/// Comma-separated values, a row per input frame: frame, time_s, output_frame, output_time_s, differential_warp,
/// smoothed_differential_warp.
std::string alignment_table(const Alignment& alignment);

/// The other way around, a row per output frame that the input covers: frame, time_s, input_frame, input_time_s,
/// differential_warp, smoothed_differential_warp. The warp's exact inverse, not an alignment of its own.
std::string inverse_table(const Alignment& alignment);

}  // namespace strut::cli
