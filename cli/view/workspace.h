// SPDX-License-Identifier: MIT
// The files that a viewing session is about: those named on the command line, and the clips that a pair list among them
// names. Nothing else is ever opened: the page knows them by their ids.
#pragma once

#include "bvh_options.h"
#include "feet_options.h"
#include "view/kept.h"

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <strut/core/diagnostics.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model.h>
#include <strut/motion/motion.h>

namespace strut::cli {

enum class ViewKind { kClip, kModel, kPairs, kDatabase };

/// What is wrong, for a person.
struct ViewProblem {
  std::string message, hint;
};

/// A file of the session.
struct ViewFile {
  std::string id;  ///< in addresses: "c0", "m0", ...
  ViewKind kind = ViewKind::kClip;
  std::string name;       ///< the file's name, with as many of its folders as tell it apart from the others
  std::string path;       ///< as it was named
  std::string listed_by;  ///< the id of the pair list that names this clip; empty: the command line does
  std::optional<ViewProblem> problem;  ///< why it cannot be used; clips that can be opened tell only when they are read
};

/// A clip that was read.
struct ViewClip {
  ViewFile file;
  BvhClip bvh;
  Diagnostics notes;
};

/// What a person said of the whole session.
struct ViewOptions {
  BvhReadOptions read;  ///< of every clip
  FeetOptions feet;     ///< of every clip that has them
  std::string rater;    ///< who labels; empty: the page asks
};

/// Thread-safe. Models, lists and databases are looked at when it is made, clips are read when they are first asked
/// for, and each is read once.
class Workspace {
 public:
  /// Files that cannot be used are part of the session, with their problem. One that is named twice is one file.
  explicit Workspace(const std::vector<std::string>& paths, ViewOptions options = {});

  [[nodiscard]] const std::vector<ViewFile>& files() const noexcept { return files_; }
  [[nodiscard]] const ViewOptions& options() const noexcept { return options_; }
  /// The file `id`. Throws Refusal (404) if there is none of this kind.
  [[nodiscard]] const ViewFile& file(const std::string& id, ViewKind kind) const;
  /// The clip of the file `id`, the model of it. Throw Refusal as file() does, and what reading throws.
  std::shared_ptr<const ViewClip> clip(const std::string& id);
  std::shared_ptr<const StyleModel> model(const std::string& id);
  /// Gives a clip that was made, not read, an id, under which clip() has it until kMostMade others have been made.
  std::string keep_made(BvhClip bvh, Diagnostics notes);

 private:
  static constexpr std::size_t kMostMade = 3;  // what the page shows, what it is about to, and what it just showed
  std::shared_ptr<const ViewClip> made_clip(const std::string& id);  // none if there is no such
  void look_at(ViewFile& file);
  void add_listed_clips();

  ViewOptions options_;
  std::vector<ViewFile> files_;
  Kept<ViewClip> clips_;
  Kept<StyleModel> models_;
  std::mutex made_mutex_;
  std::deque<std::shared_ptr<const ViewClip>> made_;  // the latest last
  int num_made_ = 0;
};

/// What a person is told of `diagnostics`: [{message, hint}].
nlohmann::ordered_json as_json(const Diagnostics& diagnostics);
nlohmann::ordered_json as_json(const ViewProblem& problem);

}  // namespace strut::cli
