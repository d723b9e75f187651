// SPDX-License-Identifier: MIT
// Marks on a motion's frames: stretches of it, and when a foot is planted.
#pragma once

#include <string>
#include <vector>

namespace strut::motion {

/// A stretch of a motion's frames.
struct FrameRange {
  int begin = 0;  ///< first frame, from 0
  int end = 0;    ///< one past the last frame

  [[nodiscard]] int num_frames() const noexcept { return end - begin; }
  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

/// A stretch of frames during which a foot stands on the ground.
struct Footplant {
  int foot = 0;   ///< which foot: an index whose meaning the giver states (0 = left, 1 = right for a biped)
  int begin = 0;  ///< first frame, from 0
  int end = 0;    ///< one past the last frame

  friend bool operator==(const Footplant&, const Footplant&) = default;
};

}  // namespace strut::motion
