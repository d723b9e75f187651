// SPDX-License-Identifier: MIT
// A pair list as the page shows it (viewer/src/pairs/pair.ts), and what two stretches have to do with each other.
#pragma once

#include "view/workspace.h"

#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include <strut/motion/annotation.h>

namespace strut::cli {

/// The line of a pair's comment that says that a person accepted it.
inline constexpr std::string_view kAcceptedLine = "accepted";

/// {version, heading, ending, pairs: [{input: {clip, frames}, output, comment, verdict}]} of the list as it is on disk:
/// `clip` is the id of a file of the session, `frames` [begin, end) or null for the whole clip, `verdict` "none",
/// "accepted" or "rejected", `version` what the page gives back when it saves. Throws what reading a list throws, and
/// Refusal (409) if the list names clips that it did not name when the session began.
nlohmann::ordered_json pair_list_answer(const Workspace& workspace, const ViewFile& list);

/// A stretch of a clip of the session.
struct ViewStretch {
  std::shared_ptr<const ViewClip> clip;
  motion::FrameRange frames;
};

/// How learning would let the output run along the input: {moments, warnings}; `moments` are frames of the output clip,
/// one for each frame of the input's stretch. Aligned as strut align does, at the slope limit that learning allows for
/// these durations. Throws Refusal where there is no alignment, saying why.
nlohmann::ordered_json pair_alignment_answer(const ViewStretch& input, const ViewStretch& output,
                                             const FeetOptions& feet);

}  // namespace strut::cli
