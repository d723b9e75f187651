// SPDX-License-Identifier: MIT
#include "view/alignment_answer.h"
#include "view/clip_answer.h"
#include "view/curve_answer.h"
#include "view/routes.h"

#include <array>
#include <memory>

#include <strut/core/version.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> kKindNames = {"clip", "model", "pairs", "database"};  // as ViewKind

Json file_as_json(const ViewFile& file) {
  Json json{{"id", file.id},
            {"kind", kKindNames.at(static_cast<std::size_t>(file.kind))},
            {"name", file.name},
            {"path", file.path}};
  if (!file.listed_by.empty()) json["listedBy"] = file.listed_by;
  if (file.problem) json["problem"] = as_json(*file.problem);
  return json;
}

Json session_of(const Workspace& workspace) {
  Json session{{"version", version()}, {"files", Json::array()}};
  for (const ViewFile& file : workspace.files()) session["files"].push_back(file_as_json(file));
  if (!workspace.options().rater.empty()) session["rater"] = workspace.options().rater;
  return session;
}

std::shared_ptr<const std::string> bytes_of(const Container& container) {
  return std::make_shared<const std::string>(container.bytes());
}

}  // namespace

void add_clip_routes(PageServer& server, Workspace& workspace) {
  const auto answers = std::make_shared<Kept<std::string>>(), alignments = std::make_shared<Kept<std::string>>();
  server.on_get("session", [&workspace](const Question&) { return json_reply(session_of(workspace)); });
  server.on_get("clips/([^/]+)", [&workspace, answers](const Question& question) {
    const auto clip = workspace.clip(question.part(1));
    return Reply{.type = kBytes, .kept = answers->get(clip->file.id, [&] {
                   return bytes_of(clip_answer(clip->file.id, clip->file.name, clip->bvh.motion, clip->notes,
                                               Packing::kExact, workspace.options().feet));
                 })};
  });
  server.on_get("alignment", [&workspace, alignments](const Question& question) {
    const auto reference = workspace.clip(question.parameter("reference"));
    const auto clip = workspace.clip(question.parameter("clip"));
    return Reply{.type = kBytes, .kept = alignments->get(reference->file.id + " " + clip->file.id, [&] {
                   return bytes_of(alignment_answer(*reference, *clip, workspace.options().feet));
                 })};
  });
  server.on_get("clips/([^/]+)/curve", [&workspace](const Question& question) {
    const auto clip = workspace.clip(question.part(1));
    return Reply{curve_answer(clip->bvh.motion, question.parameter("name")).bytes(), kBytes};
  });
}

}  // namespace strut::cli
