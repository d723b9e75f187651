// SPDX-License-Identifier: MIT
// Footplants as a table of comma-separated values: strut footplants writes it, strut learn reads it, and a person may
// edit it in between.
#pragma once

#include "paired_clips.h"

#include <string>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/motion/annotation.h>

namespace strut::cli {

/// A clip's footplants.
struct ClipFootplants {
  std::string path;
  int num_frames = 0;
  double frame_rate = 0.0;  ///< [frames/s]
  std::vector<motion::Footplant> footplants;
};

/// "left" or "right".
const char* foot_name(int foot);

/// A line of names (clip,foot,begin,end,begin_s,end_s), then a line per footplant: frames from 0, end one past the
/// last.
std::string format_footplants(const std::vector<ClipFootplants>& clips);

/// Footplants of the pair list's output clips, per clip, from the columns clip, foot, begin and end of the file at
/// `path`. A line's clip is the output clip whose path ends like it. Clips the table says nothing of get what the
/// detector finds, and clips that are no output clips are passed over; a note is made of both. Throws FileError, or
/// ParseError with line and column for anything that is not a footplant of its clip, and where the table has none of
/// any output clip.
std::vector<std::vector<motion::Footplant>> read_footplants(const std::string& path, const PairedClips& clips,
                                                            Diagnostics& diagnostics);

}  // namespace strut::cli
