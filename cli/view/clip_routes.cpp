// SPDX-License-Identifier: MIT
#include "view/clip_answer.h"
#include "view/curve_answer.h"
#include "view/routes.h"

#include <array>

#include <strut/core/version.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> kKindNames = {"clip", "model", "pairs", "database"};  // as ViewKind

Json session_of(const Workspace& workspace) {
  Json files = Json::array();
  for (const ViewFile& file : workspace.files()) {
    files.push_back({{"id", file.id},
                     {"kind", kKindNames.at(static_cast<std::size_t>(file.kind))},
                     {"name", file.name},
                     {"path", file.path}});
  }
  return {{"version", version()}, {"files", files}};
}

}  // namespace

void add_clip_routes(PageServer& server, Workspace& workspace) {
  server.on_get("session", [&](const Question&) { return Reply{session_of(workspace).dump()}; });
  server.on_get("clips/([^/]+)", [&](const Question& question) {
    const auto clip = workspace.clip(question.part(1));
    return Reply{clip_answer(clip->file.id, clip->file.name, clip->bvh.motion, clip->notes).bytes(), kBytes};
  });
  server.on_get("clips/([^/]+)/curve", [&](const Question& question) {
    const auto clip = workspace.clip(question.part(1));
    return Reply{curve_answer(clip->bvh.motion, question.parameter("name")).bytes(), kBytes};
  });
}

}  // namespace strut::cli
