// SPDX-License-Identifier: MIT
// A fragment database while raters label it in the page: what each is shown next, and their labels, stored one by one.
// A rater learns nothing of the others, of estimates, or of what a movement is called.
#pragma once

#include "view/container.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>

#include <strut/effort/fragment_database.h>
#include <strut/effort/labelling_session.h>

namespace strut::cli {

/// Thread-safe. Everything that has to be known is read from the file at every question, since other programs may add
/// blends to it or label too. Everything throws what FragmentDatabase does.
class LabelDesk {
 public:
  using Json = nlohmann::ordered_json;

  /// Opens nothing yet; the file is opened for writing when the first label comes.
  explicit LabelDesk(std::string path) : path_(std::move(path)) {}

  /// LabelProgress of viewer/src/label/types.ts. Once everything is labelled it says how well the rater repeats, and
  /// not before. Throws Refusal without a rater's name.
  Json progress(const std::string& rater);
  /// The movement of an item as a clip (clip_answer.h), which tells nothing of where it comes from. Throws Refusal if
  /// there is no such item.
  Container movement(const std::string& rater, const std::string& item);
  /// Stores a label (LabelSaid of types.ts); when this returns it is on the disk. The progress, with "stored": "now",
  /// "before" if it was there already, or "no" if another item is asked for by now.
  Json store(const Json& said);
  /// Takes back the rater's label number `done` - 1 (UndoSaid of types.ts) unless it is gone already. The progress.
  Json undo(const Json& said);

 private:
  effort::FragmentDatabase& opened(effort::Access access);
  [[nodiscard]] effort::LabellingSession session_of(const std::string& rater);
  /// What cannot be made is left out of the session.
  std::optional<effort::LabellingItem> next_that_moves(effort::LabellingSession& session);
  Json progress_now(const std::string& rater);

  std::string path_;
  std::mutex mutex_;
  std::optional<effort::FragmentDatabase> database_;
  effort::Access access_ = effort::Access::kRead;
  std::map<effort::LabelTarget, std::string> left_out_;  // blends that cannot be made, and why
};

}  // namespace strut::cli
