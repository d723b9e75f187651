// SPDX-License-Identifier: MIT
// How the output's time is divided and what a time warp may reach of it. Slots are numbered 0 ... slots - 1; an end x
// lies before slot x, so a warp runs from one end to another, and an input frame from one to a later.
#pragma once

#include <cstdint>
#include <vector>

#include <strut/align/time_warp.h>

namespace strut::align::detail {

/// The counts that an input frame may take.
struct Counts {
  int resolution;   ///< s, slots per output frame
  int least, most;  ///< s / L rounded up, s L rounded down
};

/// Throws InvalidArgument if the slope limit or the resolution is out of range.
Counts counts_of(const TimeWarpOptions& options);

/// Ends [first, last].
struct Interval {
  int first, last;
};

/// Throws InvalidArgument unless some warp of `input_frames` fits `output_frames`: says which lengths would, and which
/// slope limit or resolution.
void check_lengths(std::int64_t input_frames, std::int64_t output_frames, const Counts& counts,
                   const TimeWarpOptions& options);

/// Whether some warp fits, and no slot's number overflows.
bool fits(std::int64_t input_frames, std::int64_t output_frames, const Counts& counts, Ends ends);

/// The ends that can be reached after 0 ... input_frames input frames, from some beginning and to some end.
/// (input frames + 1)
std::vector<Interval> reachable(int input_frames, int slots, const Counts& counts, Ends ends);

/// Sum of the intervals' lengths, the first left out: what a search has to decide.
std::int64_t num_cells(const std::vector<Interval>& reach);

/// The even warp's ends: as near to filling the output as counts and ends allow. (input frames + 1)
std::vector<int> even_path(int input_frames, int slots, const Counts& counts, Ends ends);

/// The part of `reach` within `radius` slots of `path`, itself allowed or not: it is first made to obey the counts. A
/// warp through it always exists.
std::vector<Interval> band_around(std::vector<int> path, int radius, const Counts& counts,
                                  const std::vector<Interval>& reach);

}  // namespace strut::align::detail
