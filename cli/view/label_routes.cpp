// SPDX-License-Identifier: MIT
// Labelling: where a rater stands, the movements, labels in, and the last one taken back.
#include "view/label_answer.h"
#include "view/routes.h"

#include <map>
#include <memory>

namespace strut::cli {
namespace {

using Json = LabelDesk::Json;

/// The databases of the session, by the file's id.
class LabelDesks {
 public:
  explicit LabelDesks(const Workspace& workspace) : workspace_(workspace) {
    for (const ViewFile& file : workspace.files()) {
      if (file.kind == ViewKind::kDatabase) desks_.try_emplace(file.id, file.path);
    }
  }
  LabelDesk& at(const std::string& id) { return desks_.at(workspace_.file(id, ViewKind::kDatabase).id); }

 private:
  const Workspace& workspace_;
  std::map<std::string, LabelDesk> desks_;
};

Reply reply(const Json& json) {
  return {json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace

void add_label_routes(PageServer& server, Workspace& workspace) {
  const auto desks = std::make_shared<LabelDesks>(workspace);
  server.on_get("labels/([^/]+)", [desks](const Question& question) {
    return reply(desks->at(question.part(1)).progress(question.parameter("rater")));
  });
  server.on_get("labels/([^/]+)/items/([^/]+)", [desks](const Question& question) {
    LabelDesk& desk = desks->at(question.part(1));
    return Reply{desk.movement(question.parameter("rater"), question.part(2)).bytes(), kBytes};
  });
  server.on_post("labels/([^/]+)", [desks](const Question& question) {
    return reply(desks->at(question.part(1)).store(Json::parse(question.body())));
  });
  server.on_post("labels/([^/]+)/undo", [desks](const Question& question) {
    return reply(desks->at(question.part(1)).undo(Json::parse(question.body())));
  });
}

}  // namespace strut::cli
