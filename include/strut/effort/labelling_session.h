// SPDX-License-Identifier: MIT
// In which order a rater is shown fragments and blends: at random, another order for every rater, about one in ten of
// them a blind repeat of what the rater labelled before. All of it follows from the rater's name, what there is to
// label and what the rater has labelled so far, so that nothing but the labels has to be kept to go on another day.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <strut/effort/fragment_database.h>

namespace strut::effort {

/// Every tenth step, on the average, is a repeat, and of what was last labelled this many steps ago or more.
inline constexpr int kStepsPerRepeat = 10;
inline constexpr int kLeastStepsBetween = 8;

/// One showing of a fragment or blend to a rater.
struct LabellingItem {
  LabelTarget target;
  int step = 0;            ///< how many labels the rater had given before
  bool is_repeat = false;  ///< whether the rater has labelled it before
};

/// What the labels in `labels` that the person `rater` gave are about, oldest first.
std::vector<LabelTarget> labelled_by(const std::vector<LabelRecord>& labels, const std::string& rater);

/// Where one rater stands. At every step each of what is not labelled yet is equally likely to come next, so what is
/// added later joins it, and what is taken away changes nothing but that. Steps, not moments, decide, so whoever
/// undoes a label is shown the same again.
class LabellingSession {
 public:
  /// `targets`: what there is to label, in any order; `labelled`: what the rater's labels are about, oldest first,
  /// repeats included. Labels of what is not among the targets count as steps alone.
  /// Cost O((targets + labelled) log targets).
  LabellingSession(std::string_view rater, const std::vector<LabelTarget>& targets,
                   const std::vector<LabelTarget>& labelled);

  /// Labels given, repeats included: the number of the next step.
  [[nodiscard]] int num_labelled() const noexcept { return static_cast<int>(history_.size()); }
  /// Labels given once everything is labelled, repeats included.
  [[nodiscard]] int num_steps() const;
  [[nodiscard]] bool is_finished() const noexcept { return num_open_ == 0; }
  /// What is to be labelled now; nothing once every target has a label. Cost O(targets).
  [[nodiscard]] std::optional<LabellingItem> next() const;

  /// Goes on as if `target` had just been labelled.
  void record(const LabelTarget& target);
  /// Goes on without `target`, as if it had never been among the targets.
  void leave_out(const LabelTarget& target);

  /// A name for an item that tells nobody what it is: a repeat's is another than the first showing's.
  [[nodiscard]] std::string name_of(const LabellingItem& item) const;
  /// The item of that name, whatever its step: labelled if the step is before num_labelled(), and then only if it was
  /// this that was labelled there. Nothing if there is none. Cost O(targets).
  [[nodiscard]] std::optional<LabellingItem> find(const std::string& name) const;

 private:
  /// What the rater has said of a target so far.
  struct Showings {
    int count = 0, last_step = 0;
  };

  [[nodiscard]] bool is_repeat_step(int step) const;
  [[nodiscard]] std::optional<LabelTarget> to_repeat() const;
  [[nodiscard]] LabelTarget to_open() const;

  std::uint64_t seed_;
  std::map<LabelTarget, Showings> showings_;  // of every target
  std::vector<LabelTarget> history_;
  int num_open_ = 0;
};

}  // namespace strut::effort
