// SPDX-License-Identifier: MIT
#include "view/alignment_answer.h"

#include "alignment.h"
#include "input_files.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace strut::cli {
namespace {

// Of both clips, at the reference's rate: with 60 joints they take about 10 s and 3 GB to align. docs/viewer.md.
constexpr double kMostFrames = 100'000;

void check_length(const ViewClip& reference, const ViewClip& clip) {
  const double frames =
      reference.bvh.motion.num_frames() + clip.bvh.motion.duration() * reference.bvh.motion.frame_rate();
  if (frames <= kMostFrames) return;
  throw BadInput(clip.file.path,
                 fmt::format("is with {} too long to be aligned while somebody waits: {:.0f} frames, at most {:.0f}",
                             reference.file.path, frames, kMostFrames),
                 "cut the clips, or align them with strut align");
}

/// The smoothed warp in frames of the clip as it was recorded.
std::vector<float> moments_of(const Alignment& alignment, const Motion& clip) {
  const double frames_per_frame = clip.frame_rate() / alignment.input->motion.frame_rate();
  const double last = clip.num_frames() - 1;
  std::vector<float> moments;
  moments.reserve(static_cast<std::size_t>(alignment.smoothed.output_time.size()));
  for (const double moment : alignment.smoothed.output_time) {
    moments.push_back(static_cast<float>(std::clamp(moment * frames_per_frame, 0.0, last)));
  }
  return moments;
}

}  // namespace

Container alignment_answer(const ViewClip& reference, const ViewClip& clip, const FeetOptions& feet) {
  check_length(reference, clip);
  const AlignClip input = align_clip(reference.file.path, reference.bvh.motion);
  AlignOptions options;
  options.feet = feet;
  Diagnostics doubts;
  const Alignment found = align_clips(input, align_clip(clip.file.path, clip.bvh.motion), options, doubts);
  Container container({{"reference", reference.file.id},
                       {"clip", clip.file.id},
                       {"method", found.method->title},
                       {"warnings", as_json(doubts)}});
  container.add("moments", moments_of(found, clip.bvh.motion));
  return container;
}

}  // namespace strut::cli
