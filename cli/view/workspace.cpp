// SPDX-License-Identifier: MIT
#include "view/workspace.h"

#include "input_files.h"
#include "view/page_server.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include <strut/blend/gait_model_io.h>
#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/effort/effort_model_io.h>
#include <strut/effort/fragment_database.h>
#include <strut/io/pair_list.h>
#include <strut/model/style_model_io.h>

namespace strut::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWanted = "a clip (BVH), a style model, a pair list or a fragment database";

/// By what is in it; one that tells nothing by its ending, and what is none of the others is to be a clip.
ViewKind kind_of(const std::string& path) {
  const std::string head = first_bytes(path);
  if (is_style_model(head) || blend::is_gait_model(head) || effort::is_effort_model(head)) return ViewKind::kModel;
  if (effort::is_fragment_database(head)) return ViewKind::kDatabase;
  if (head.starts_with("HIERARCHY")) return ViewKind::kClip;
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".toml" || head.starts_with("[[pair]]") || head.find("\n[[pair]]") != std::string::npos) {
    return ViewKind::kPairs;
  }
  return ending == ".strut" ? ViewKind::kModel : ViewKind::kClip;
}

/// Throws, in the words of what reads such files, if the clip at `path` cannot be opened.
void check_opens(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw FileError(FileAction::kRead, path, "is a folder, not a file",
                    "name the files in it: " + (fs::path(path) / "*.bvh").string());
  }
  const bool is_other = fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
  if (is_other || std::ifstream(path)) return;  // a pipe's bytes come once
  static_cast<void>(read_file(path));
}

/// Throws if the model at `path` is one that another command plays.
void check_is_style_model(const std::string& path) {
  const std::string head = first_bytes(path);
  if (blend::is_gait_model(head)) {
    throw ParseError(path, 0, 0, kWanted, "a gait model",
                     "strut blend makes clips of it: strut blend " + path + " -o OUT.bvh");
  }
  if (effort::is_effort_model(head)) {
    throw ParseError(path, 0, 0, kWanted, "an Effort model", "strut effort apply puts an Effort on a clip with it");
  }
}

/// What two names of one file have in common.
std::string identity_of(const std::string& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path : canonical.string();
}

/// The last `depth` components of `path`; all of it where it has no more.
std::string tail_of(const fs::path& path, std::ptrdiff_t depth) {
  const auto length = std::distance(path.begin(), path.end());
  fs::path tail;
  for (auto part = std::next(path.begin(), std::max<std::ptrdiff_t>(length - depth, 0)); part != path.end(); ++part) {
    tail /= *part;
  }
  return tail.string();
}

/// Names every file by as few components of its path as tell it apart.
void name_apart(std::vector<ViewFile>& files) {
  std::vector<std::pair<ViewFile*, fs::path>> alike;
  for (ViewFile& file : files) alike.emplace_back(&file, fs::absolute(file.path).lexically_normal());
  for (std::ptrdiff_t depth = 1; !alike.empty(); ++depth) {
    std::map<std::string, int> counts;
    for (auto& [file, path] : alike) {
      const std::string shorter = std::exchange(file->name, tail_of(path, depth));
      if (file->name != shorter) ++counts[file->name];
    }
    // Where no more of a path is left it is as told apart as it gets.
    std::erase_if(alike, [&](const auto& entry) { return counts[entry.first->name] <= 1; });
  }
}

std::string id_of(ViewKind kind, const std::vector<ViewFile>& files) {
  const auto number =
      std::count_if(files.begin(), files.end(), [&](const ViewFile& file) { return file.kind == kind; });
  return fmt::format("{}{}", "cmpd"[static_cast<std::size_t>(kind)], number);
}

}  // namespace

Workspace::Workspace(const std::vector<std::string>& paths, ViewOptions options) : options_(std::move(options)) {
  std::set<std::string> known;
  for (const std::string& path : paths) {
    if (!known.insert(identity_of(path)).second) continue;
    const ViewKind kind = kind_of(path);
    files_.push_back({id_of(kind, files_), kind, {}, path, {}, {}});
  }
  for (ViewFile& file : files_) look_at(file);
  add_listed_clips();
  name_apart(files_);
}

/// Notes why `file` cannot be used.
void Workspace::look_at(ViewFile& file) {
  try {
    switch (file.kind) {
      case ViewKind::kClip:
        return check_opens(file.path);
      case ViewKind::kModel:
        check_is_style_model(file.path);
        return static_cast<void>(model(file.id));
      case ViewKind::kPairs:
        return static_cast<void>(read_pair_list(file.path));
      case ViewKind::kDatabase:
        return static_cast<void>(effort::FragmentDatabase::open(file.path));
    }
  } catch (const Error& error) {
    file.problem = {error.what(), error.hint()};
  }
}

void Workspace::add_listed_clips() {
  std::set<std::string> known;
  for (const ViewFile& file : files_) known.insert(identity_of(file.path));
  std::vector<ViewFile> lists;
  for (const ViewFile& file : files_) {
    if (file.kind == ViewKind::kPairs && !file.problem) lists.push_back(file);
  }
  for (const ViewFile& list : lists) {
    for (const PairListEntry& pair : read_pair_list(list.path)) {
      for (const std::string& path : {pair.input.path, pair.output.path}) {
        if (!known.insert(identity_of(path)).second) continue;
        files_.push_back({id_of(ViewKind::kClip, files_), ViewKind::kClip, {}, path, list.id, {}});
        look_at(files_.back());
      }
    }
  }
}

const ViewFile& Workspace::file(const std::string& id, ViewKind kind) const {
  const auto found = std::find_if(files_.begin(), files_.end(),
                                  [&](const ViewFile& file) { return file.id == id && file.kind == kind; });
  if (found == files_.end()) throw Refusal{404, "there is no file '" + id + "' of this kind in the session", {}};
  return *found;
}

std::string Workspace::keep_made(BvhClip bvh, Diagnostics notes) {
  const std::scoped_lock lock(made_mutex_);
  ViewFile file;
  file.id = fmt::format("made-{}", num_made_++);
  made_.push_back(std::make_shared<const ViewClip>(ViewClip{std::move(file), std::move(bvh), std::move(notes)}));
  if (made_.size() > kMostMade) made_.pop_front();
  return made_.back()->file.id;
}

std::shared_ptr<const ViewClip> Workspace::made_clip(const std::string& id) {
  const std::scoped_lock lock(made_mutex_);
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const auto& clip) { return clip->file.id == id; });
  return found == made_.end() ? nullptr : *found;
}

std::shared_ptr<const ViewClip> Workspace::clip(const std::string& id) {
  if (auto made = made_clip(id)) return made;
  const ViewFile& named = file(id, ViewKind::kClip);
  return clips_.get(id, [&] {
    Diagnostics notes;
    BvhClip bvh = read_bvh(named.path, options_.read, &notes);
    return std::make_shared<const ViewClip>(ViewClip{named, std::move(bvh), std::move(notes)});
  });
}

std::shared_ptr<const StyleModel> Workspace::model(const std::string& id) {
  const ViewFile& named = file(id, ViewKind::kModel);
  return models_.get(id, [&] { return read_style_model(named.path); });
}

nlohmann::ordered_json as_json(const ViewProblem& problem) {
  nlohmann::ordered_json json{{"message", problem.message}};
  if (!problem.hint.empty()) json["hint"] = problem.hint;
  return json;
}

nlohmann::ordered_json as_json(const Diagnostics& diagnostics) {
  auto all = nlohmann::ordered_json::array();
  for (const Diagnostic& entry : diagnostics.entries()) {
    all.push_back(as_json({entry.where.empty() ? entry.message : entry.where + ": " + entry.message, entry.hint}));
  }
  return all;
}

}  // namespace strut::cli
