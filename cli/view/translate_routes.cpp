// SPDX-License-Identifier: MIT
// Translate: what models are, a style put on a clip as the page's controls say, and the result as a file.
#include "model_info.h"
#include "style_options.h"
#include "translated_clip.h"
#include "view/clip_answer.h"
#include "view/routes.h"
#include "view/translate_request.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <strut/io/bvh.h>

namespace strut::cli {
namespace {

TranslatedClip translate(const TranslateRequest& request, Workspace& workspace, Diagnostics& diagnostics) {
  std::vector<std::string> paths;
  std::vector<std::shared_ptr<const StyleModel>> models;
  for (const std::string& id : request.models) {
    paths.push_back(workspace.file(id, ViewKind::kModel).path);
    models.push_back(workspace.model(id));
  }
  check_blend(paths, models);
  const auto clip = workspace.clip(request.clip);
  return translate_file(clip->file.path, clip->bvh, models, request.options, request.keep_layout, &diagnostics);
}

/// The result under an id of its own, as it is another clip each time.
Reply translated(const Question& question, Workspace& workspace) {
  const TranslateRequest request = parse_translate_request(question.body());
  Diagnostics notes;
  TranslatedClip result = translate(request, workspace, notes);
  const std::string id = workspace.keep_made({result.translation.motion, std::move(result.layout)}, notes);
  Container answer = clip_answer(id, output_name(request, workspace), workspace.clip(id)->bvh.motion, notes,
                                 Packing::kExact, workspace.options().feet);
  if (request.options.retime) answer.add("moments", as_floats(result.translation.moments));
  return {answer.bytes(), kBytes};
}

Reply as_file(const Question& question, Workspace& workspace) {
  const TranslateRequest request = parse_translate_request(question.body());
  Diagnostics notes;
  const TranslatedClip result = translate(request, workspace, notes);
  return {format_bvh(result.translation.motion, result.layout, &notes), "text/plain; charset=utf-8",
          output_name(request, workspace)};
}

}  // namespace

void add_translate_routes(PageServer& server, Workspace& workspace) {
  server.on_get("models/([^/]+)", [&](const Question& question) {
    const ViewFile& file = workspace.file(question.part(1), ViewKind::kModel);
    return json_reply(model_as_json(file.path, *workspace.model(file.id)));
  });
  server.on_get("translate/controls", [](const Question&) { return json_reply(controls_as_json()); });
  server.on_post("translate", [&](const Question& question) { return translated(question, workspace); });
  server.on_post("translate/bvh", [&](const Question& question) { return as_file(question, workspace); });
  server.on_post("translate/command", [&](const Question& question) {
    const TranslateRequest request = parse_translate_request(question.body());
    return json_reply({{"command", command_line(request, workspace)}, {"saveAs", output_name(request, workspace)}});
  });
}

}  // namespace strut::cli
