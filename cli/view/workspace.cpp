// SPDX-License-Identifier: MIT
#include "view/workspace.h"

#include "view/page_server.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fmt/core.h>

#include <strut/effort/fragment_database.h>
#include <strut/model/style_model_io.h>

namespace strut::cli {
namespace {

constexpr std::size_t kHeadBytes = 4096;  // enough to tell kinds of files apart

std::string head_of(const std::string& path) {
  std::string head(kHeadBytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

/// By what is in it; a file that is none of the others is to be a clip.
ViewKind kind_of(const std::string& path) {
  const std::string head = head_of(path);
  if (is_style_model(head)) return ViewKind::kModel;
  if (effort::is_fragment_database(head)) return ViewKind::kDatabase;
  return std::filesystem::path(path).extension() == ".toml" ? ViewKind::kPairs : ViewKind::kClip;
}

}  // namespace

Workspace::Workspace(const std::vector<std::string>& paths) {
  std::map<ViewKind, int> counts;
  for (const std::string& path : paths) {
    const ViewKind kind = kind_of(path);
    const std::string id = fmt::format("{}{}", "cmpd"[static_cast<std::size_t>(kind)], counts[kind]++);
    files_.push_back({id, kind, std::filesystem::path(path).filename().string(), path});
  }
}

const ViewFile& Workspace::file(const std::string& id, ViewKind kind) const {
  const auto found = std::find_if(files_.begin(), files_.end(),
                                  [&](const ViewFile& file) { return file.id == id && file.kind == kind; });
  if (found == files_.end()) throw Refusal{404, "there is no file '" + id + "' of this kind in the session", {}};
  return *found;
}

std::shared_ptr<const ViewClip> Workspace::clip(const std::string& id) {
  const ViewFile& named = file(id, ViewKind::kClip);
  const std::scoped_lock lock(mutex_);
  std::shared_ptr<const ViewClip>& kept = clips_[id];
  if (!kept) {
    Diagnostics notes;
    BvhClip bvh = read_bvh(named.path, {}, &notes);
    kept = std::make_shared<const ViewClip>(ViewClip{named, std::move(bvh), std::move(notes)});
  }
  return kept;
}

std::shared_ptr<const StyleModel> Workspace::model(const std::string& id) {
  const ViewFile& named = file(id, ViewKind::kModel);
  const std::scoped_lock lock(mutex_);
  std::shared_ptr<const StyleModel>& kept = models_[id];
  if (!kept) kept = read_style_model(named.path);
  return kept;
}

nlohmann::ordered_json as_json(const Diagnostics& diagnostics) {
  auto all = nlohmann::ordered_json::array();
  for (const Diagnostic& entry : diagnostics.entries()) {
    all.push_back(
        {{"message", entry.where.empty() ? entry.message : entry.where + ": " + entry.message}, {"hint", entry.hint}});
  }
  return all;
}

}  // namespace strut::cli
