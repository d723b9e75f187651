// SPDX-License-Identifier: MIT
// Pair lists: read, aligned, and saved to the very file that was opened, whole or not at all, unless somebody else
// changed it meanwhile.
#include "fingerprint.h"
#include "view/pair_answer.h"
#include "view/pair_request.h"
#include "view/routes.h"

#include <filesystem>
#include <memory>
#include <mutex>

#include <strut/core/file.h>
#include <strut/io/pair_list.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kConflict = 409;

void check_unchanged(const ViewFile& list, const std::string& version) {
  if (fingerprint(read_file(list.path)) == version) return;
  throw Refusal{kConflict, list.name + " was changed on disk since it was read here; nothing was written",
                "save a copy of what you made, or read the file again, which gives up what was changed here"};
}

Reply save(const Question& question, Workspace& workspace) {
  const ViewFile& list = workspace.file(question.part(1), ViewKind::kPairs);
  const Json body = Json::parse(question.body());
  const std::string text = format_pair_list(pair_list_of(body, workspace), list.path);
  check_unchanged(list, body.at("version").get<std::string>());
  write_file(list.path, text, Overwrite::kAllow);
  return {Json{{"version", fingerprint(text)}}.dump()};
}

Reply text_of(const Question& question, Workspace& workspace) {
  const ViewFile& list = workspace.file(question.part(1), ViewKind::kPairs);
  const PairList pairs = pair_list_of(Json::parse(question.body()), workspace);
  return {format_pair_list(pairs, list.path), "application/toml", std::filesystem::path(list.path).filename().string()};
}

Reply alignment_of(const Question& question, Workspace& workspace) {
  const Json body = Json::parse(question.body());
  return {pair_alignment_answer(stretch_of(body.at("input"), workspace), stretch_of(body.at("output"), workspace),
                                workspace.options().feet)
              .dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace

void add_pair_routes(PageServer& server, Workspace& workspace) {
  server.on_get("pairs/([^/]+)", [&](const Question& question) {
    const ViewFile& list = workspace.file(question.part(1), ViewKind::kPairs);
    return Reply{pair_list_answer(workspace, list).dump(-1, ' ', false, Json::error_handler_t::replace)};
  });
  // One at a time, or two pages could both find the file unchanged.
  const auto one_at_a_time = std::make_shared<std::mutex>();
  server.on_put("pairs/([^/]+)", [&, one_at_a_time](const Question& question) {
    const std::scoped_lock lock(*one_at_a_time);
    return save(question, workspace);
  });
  server.on_post("pairs/([^/]+)/text", [&](const Question& question) { return text_of(question, workspace); });
  server.on_post("pairs/([^/]+)/alignment",
                 [&](const Question& question) { return alignment_of(question, workspace); });
}

}  // namespace strut::cli
