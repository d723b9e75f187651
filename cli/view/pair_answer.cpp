// SPDX-License-Identifier: MIT
#include "view/pair_answer.h"

#include "alignment.h"
#include "fingerprint.h"
#include "view/page_server.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/core.h>

#include <strut/core/file.h>
#include <strut/io/pair_list.h>
#include <strut/learn/clip_pair.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kConflict = 409;

/// A path by which two names of one file are equal.
std::string place_of(const std::string& path) {
  return std::filesystem::weakly_canonical(path).string();
}

std::map<std::string, std::string> clip_ids(const Workspace& workspace) {
  std::map<std::string, std::string> ids;
  for (const ViewFile& file : workspace.files()) {
    if (file.kind == ViewKind::kClip) ids.emplace(place_of(file.path), file.id);
  }
  return ids;
}

Json side_of(const PairedClip& clip, const std::map<std::string, std::string>& ids) {
  const auto found = ids.find(place_of(clip.path));
  if (found == ids.end()) {
    throw Refusal{kConflict, "the list names " + clip.path + " now, which it did not when strut view was started",
                  "start strut view again"};
  }
  return {{"clip", found->second},
          {"frames", clip.frames ? Json{clip.frames->begin, clip.frames->end} : Json(nullptr)}};
}

/// Takes the line that says so out of `comment`.
bool take_accepted(std::string& comment) {
  std::istringstream lines(comment);
  std::string kept;
  bool is_accepted = false;
  for (std::string line; std::getline(lines, line);) {
    const bool says_so = line == kAcceptedLine;
    is_accepted = is_accepted || says_so;
    if (!says_so) kept += (kept.empty() ? "" : "\n") + line;
  }
  comment = kept;
  return is_accepted;
}

Json pair_of(const PairListEntry& entry, bool is_rejected, const std::map<std::string, std::string>& ids) {
  std::string comment = entry.comment;
  const bool is_accepted = take_accepted(comment);
  return {{"input", side_of(entry.input, ids)},
          {"output", side_of(entry.output, ids)},
          {"comment", comment},
          {"verdict", is_rejected ? "rejected" : (is_accepted ? "accepted" : "none")}};
}

double rate_of(const ViewStretch& stretch) {
  return stretch.clip->bvh.motion.frame_rate();
}

double seconds_of(const ViewStretch& stretch) {
  return stretch.frames.num_frames() / rate_of(stretch);
}

AlignClip cut(const ViewStretch& stretch) {
  return align_clip(stretch.clip->file.name, stretch.clip->bvh.motion.slice(stretch.frames.begin, stretch.frames.end));
}

void warn_if_short(const ViewStretch& stretch, Diagnostics& warnings) {
  if (seconds_of(stretch) >= learn::kShortestStretch) return;
  warnings.warn(stretch.clip->file.name,
                fmt::format("it lasts {:.2f} s; strut learn leaves out pairs shorter than {:.1f} s",
                            seconds_of(stretch), learn::kShortestStretch));
}

int slope_limit_of(const ViewStretch& input, const ViewStretch& output) {
  const int limit = learn::slope_limit_for(seconds_of(input), seconds_of(output));
  if (limit > 0) return limit;
  throw Refusal{
      400,
      fmt::format("the input lasts {:.2f} s and the output {:.2f} s: stretches whose durations differ by more "
                  "than a factor of 3 cannot be aligned",
                  seconds_of(input), seconds_of(output)),
      "strut learn leaves such a pair out: cut it anew or reject it"};
}

}  // namespace

Json pair_list_answer(const Workspace& workspace, const ViewFile& list) {
  const std::string text = read_file(list.path);
  const PairList read = parse_annotated_pair_list(text, list.path);
  const auto ids = clip_ids(workspace);
  Json pairs = Json::array();
  for (const PairListEntry& entry : read.pairs) pairs.push_back(pair_of(entry, false, ids));
  for (const PairListEntry& entry : read.rejected) pairs.push_back(pair_of(entry, true, ids));
  return {{"version", fingerprint(text)}, {"heading", read.heading}, {"ending", read.ending}, {"pairs", pairs}};
}

Json pair_alignment_answer(const ViewStretch& input, const ViewStretch& output, const FeetOptions& feet) {
  AlignOptions options;
  options.feet = feet;
  options.settings.slope_limit = slope_limit_of(input, output);
  Diagnostics warnings, notes;
  warn_if_short(input, warnings);
  warn_if_short(output, warnings);
  const AlignClip reference = cut(input);
  const Alignment alignment = align_clips(reference, cut(output), options, notes);
  warnings.append(alignment.warnings);
  // The output may have been resampled to the input's rate.
  const double scale = rate_of(output) / rate_of(input);
  Json moments = Json::array();
  const double last = output.frames.num_frames() - 1;
  for (const double time : alignment.smoothed.output_time) {
    moments.push_back(output.frames.begin + std::clamp(scale * time, 0.0, last));
  }
  return {{"moments", moments}, {"warnings", as_json(warnings)}};
}

}  // namespace strut::cli
