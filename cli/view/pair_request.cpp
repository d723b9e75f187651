// SPDX-License-Identifier: MIT
#include "view/pair_request.h"

#include "view/page_server.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>

#include <strut/core/error.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

std::optional<motion::FrameRange> frames_of(const Json& side) {
  const Json& frames = side.at("frames");
  if (frames.is_null()) return std::nullopt;
  if (frames.size() != 2 || !frames.at(0).is_number_integer() || !frames.at(1).is_number_integer()) {
    throw Refusal{400, "frames are two whole numbers", {}};
  }
  const auto begin = frames.at(0).get<std::int64_t>(), end = frames.at(1).get<std::int64_t>();
  if (begin < 0 || end <= begin || end > std::numeric_limits<int>::max()) {
    throw Refusal{400, fmt::format("frames {} to {} are no stretch of a clip", begin, end),
                  "they count from 0, and the end is not included"};
  }
  return motion::FrameRange{static_cast<int>(begin), static_cast<int>(end)};
}

void check_within(const motion::FrameRange& frames, const ViewClip& clip) {
  const int num_frames = clip.bvh.motion.num_frames();
  if (frames.end <= num_frames) return;
  throw Refusal{400,
                fmt::format("frames {} to {} reach beyond {}, which has {}", frames.begin, frames.end, clip.file.name,
                            num_frames),
                "cut the pair anew, or reject it"};
}

std::shared_ptr<const ViewClip> clip_if_readable(const std::string& id, Workspace& workspace) {
  try {
    return workspace.clip(id);
  } catch (const Error&) {
    return nullptr;  // its frames are not known; a list that names it can be saved all the same
  }
}

PairedClip side_of(const Json& side, bool is_rejected, Workspace& workspace) {
  const ViewFile& file = workspace.file(side.at("clip").get<std::string>(), ViewKind::kClip);
  PairedClip clip{file.path, frames_of(side)};
  if (is_rejected || !clip.frames) return clip;
  if (const auto read = clip_if_readable(file.id, workspace)) check_within(*clip.frames, *read);
  return clip;
}

PairListEntry entry_of(const Json& pair, Workspace& workspace) {
  const auto verdict = pair.at("verdict").get<std::string>();
  const bool is_rejected = verdict == "rejected";
  if (!is_rejected && verdict != "none" && verdict != "accepted") {
    throw Refusal{400, "the verdict '" + verdict + "' is none that is known", {}};
  }
  PairListEntry entry{side_of(pair.at("input"), is_rejected, workspace),
                      side_of(pair.at("output"), is_rejected, workspace), pair.at("comment").get<std::string>()};
  if (verdict == "accepted") entry.comment += (entry.comment.empty() ? "" : "\n") + std::string(kAcceptedLine);
  return entry;
}

PairListEntry entry_named(const Json& pair, std::size_t number, Workspace& workspace) {
  try {
    return entry_of(pair, workspace);
  } catch (Refusal& refusal) {
    refusal.message = fmt::format("pair {}: {}", number, refusal.message);
    throw;
  }
}

}  // namespace

PairList pair_list_of(const Json& body, Workspace& workspace) {
  PairList list{body.at("heading").get<std::string>(), {}, {}, body.at("ending").get<std::string>()};
  std::size_t number = 0;
  for (const Json& pair : body.at("pairs")) {
    PairListEntry entry = entry_named(pair, ++number, workspace);
    (pair.at("verdict") == "rejected" ? list.rejected : list.pairs).push_back(std::move(entry));
  }
  if (list.pairs.empty()) {
    throw Refusal{400, "a list needs at least one pair that is not rejected", "delete the file if none is of use"};
  }
  return list;
}

ViewStretch stretch_of(const Json& side, Workspace& workspace) {
  auto clip = workspace.clip(side.at("clip").get<std::string>());
  const auto frames = frames_of(side).value_or(motion::FrameRange{0, clip->bvh.motion.num_frames()});
  check_within(frames, *clip);
  return {std::move(clip), frames};
}

}  // namespace strut::cli
