// SPDX-License-Identifier: MIT
// Several clips on one timeline that none of them sets, as strut align --groupwise finds it: the correspondences, what
// they are worth, the report and the tables.
#pragma once

#include "alignment.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <strut/align/groupwise.h>
#include <strut/core/diagnostics.h>

namespace strut::cli {

/// How far apart footplants of the clips are where the timeline puts them together, over all pairs of clips.
struct GroupOnsets {
  int num_onsets = 0;  ///< of the first clip of every pair
  int num_pairs = 0;   ///< of them, paired with one of the second clip
  double mean = 0.0;   ///< of the pairs' distances [s]
};

/// Clips, aligned with their common timeline.
struct GroupAlignment {
  std::vector<AlignClip> clips;  ///< at one frame rate
  const AlignMethod* method = nullptr;
  SignalSet signals = SignalSet::kAll;
  int num_compared = 0;  ///< signals that tell anything
  double slope_limit = 0.0;
  align::GroupAlignment found{};
  std::optional<GroupOnsets> onsets{}, even{};  ///< `even`: every clip stretched evenly over the timeline
  std::string no_plants{};                      ///< why they are missing

  [[nodiscard]] double frame_rate() const { return clips.front().motion.frame_rate(); }
};

/// Aligns `clips` with their timeline; those of another frame rate than the first are resampled. Throws InvalidArgument
/// for options that do not go together, SkeletonMismatch, and BadInput, naming the clip, where there is nothing to
/// align by or no alignment within the limits.
GroupAlignment align_clips_groupwise(std::vector<AlignClip> clips, const AlignOptions& options,
                                     Diagnostics& diagnostics);

/// A few lines.
std::string group_in_words(const GroupAlignment& group);

/// The same figures, times in seconds.
nlohmann::ordered_json group_as_json(const GroupAlignment& group);

/// Comma-separated values for a clip, a row per frame of the timeline: frame, time_s, clip_frame, clip_time_s,
/// differential_warp.
std::string group_table(const GroupAlignment& group, std::size_t clip);

/// The other way around, a row per frame of the clip: frame, time_s, timeline_frame, timeline_time_s,
/// differential_warp.
std::string group_inverse_table(const GroupAlignment& group, std::size_t clip);

}  // namespace strut::cli
