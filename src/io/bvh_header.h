// SPDX-License-Identifier: MIT
// The part of a BVH file before its numbers: hierarchy, frame count, frame time.
#pragma once

#include "bvh_text.h"

#include <cstddef>
#include <string>
#include <vector>

#include <strut/io/bvh.h>
#include <strut/motion/skeleton.h>

namespace strut::io::detail {

/// More frames than anybody records: five days at 240 frames/s.
inline constexpr long long kMostFrames = 100'000'000;

/// The header as it stands in the file.
struct BvhHeader {
  std::vector<Joint> joints;                      ///< lengths in the file's unit and axes
  std::vector<std::vector<BvhChannel>> channels;  ///< per joint
  int num_channels = 0;                           ///< of all joints
  long long num_frames = 0;                       ///< as claimed
  std::string num_frames_line;                    ///< where it claims so, for a diagnostic
  std::string text;                               ///< everything before that number
  std::string frame_time_lead;                    ///< everything between that number and the frame time
  std::string frame_time;                         ///< as printed
  double frame_rate = 0.0;                        ///< snapped [frames/s]
};

/// Reads the header and leaves the cursor at the end of its last line. Throws ParseError.
BvhHeader parse_header(BvhCursor& cursor);

/// The frame rate [frames/s] meant by a printed frame time [s]: the usual rate within 1e-3 of it, else its inverse.
double snapped_frame_rate(double frame_time);

/// A channel's name as files write it, e.g. "Zrotation".
const char* channel_name(BvhChannel channel);

}  // namespace strut::io::detail
