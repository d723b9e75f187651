// SPDX-License-Identifier: MIT
// The files that a viewing session is about: those named on the command line, and the clips that a pair list among them
// names. Nothing else is ever opened.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <strut/core/diagnostics.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model.h>
#include <strut/motion/motion.h>

namespace strut::cli {

enum class ViewKind { kClip, kModel, kPairs, kDatabase };

/// A file of the session.
struct ViewFile {
  std::string id;  ///< in addresses: "c0", "m0", ...
  ViewKind kind = ViewKind::kClip;
  std::string name, path;
};

/// A clip that was read.
struct ViewClip {
  ViewFile file;
  BvhClip bvh;
  Diagnostics notes;
};

/// Thread-safe: files are read when they are first asked for, and kept.
class Workspace {
 public:
  explicit Workspace(const std::vector<std::string>& paths);

  [[nodiscard]] const std::vector<ViewFile>& files() const noexcept { return files_; }
  /// The file `id`. Throws Refusal (404) if there is none of this kind.
  [[nodiscard]] const ViewFile& file(const std::string& id, ViewKind kind) const;
  /// The clip of the file `id`. Throws Refusal as file() does, and what reading throws.
  std::shared_ptr<const ViewClip> clip(const std::string& id);
  /// The model of the file `id`, likewise.
  std::shared_ptr<const StyleModel> model(const std::string& id);

 private:
  std::vector<ViewFile> files_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const ViewClip>> clips_;
  std::map<std::string, std::shared_ptr<const StyleModel>> models_;
};

/// What a person is told of `diagnostics`: [{message, hint}].
nlohmann::ordered_json as_json(const Diagnostics& diagnostics);

}  // namespace strut::cli
