// SPDX-License-Identifier: MIT
// Chance is a hash of rater, step and target: of what may come, the one with the smallest hash does (rendezvous
// hashing, Thaler and Ravishankar 1998), so adding or taking away others changes the choice no more than it must.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <limits>
#include <tuple>

#include <strut/effort/labelling_session.h>

namespace strut::effort {
namespace {

/// What a hash decides.
enum class Purpose : std::uint64_t { kOrder = 1, kRepeat, kWhenToRepeat, kName };

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15U;
  bits = (bits ^ bits >> 30U) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ bits >> 27U) * 0x94d049bb133111ebU;
  return bits ^ bits >> 31U;
}

/// FNV-1a, 64 bits: the same everywhere, as std::hash is not.
std::uint64_t seed_of(std::string_view rater) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : rater) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

std::uint64_t chance(std::uint64_t seed, Purpose purpose, int number) {
  return mixed(mixed(seed ^ mixed(static_cast<std::uint64_t>(purpose))) + static_cast<std::uint64_t>(number));
}

std::uint64_t chance(std::uint64_t seed, Purpose purpose, int step, const LabelTarget& target) {
  const std::uint64_t kind = target.kind == TargetKind::kBlend ? 1 : 0;
  return mixed(chance(seed, purpose, step) ^ (static_cast<std::uint64_t>(target.id) << 1U | kind));
}

}  // namespace

std::vector<LabelTarget> labelled_by(const std::vector<LabelRecord>& labels, const std::string& rater) {
  std::vector<LabelTarget> targets;
  for (const LabelRecord& label : labels) {
    if (label.rater == rater && label.source == LabelSource::kPerson) targets.push_back(label.target);
  }
  return targets;
}

LabellingSession::LabellingSession(std::string_view rater, const std::vector<LabelTarget>& targets,
                                   const std::vector<LabelTarget>& labelled)
    : seed_(seed_of(rater)) {
  for (const LabelTarget& target : targets) showings_.try_emplace(target);
  num_open_ = static_cast<int>(showings_.size());
  for (const LabelTarget& target : labelled) record(target);
}

void LabellingSession::record(const LabelTarget& target) {
  if (const auto found = showings_.find(target); found != showings_.end()) {
    if (found->second.count++ == 0) --num_open_;
    found->second.last_step = num_labelled();
  }
  history_.push_back(target);
}

void LabellingSession::leave_out(const LabelTarget& target) {
  const auto found = showings_.find(target);
  if (found == showings_.end()) return;
  if (found->second.count == 0) --num_open_;
  showings_.erase(found);
}

bool LabellingSession::is_repeat_step(int step) const {
  // One place in every ten; in the first ten the last two, where something is far enough back.
  const int block = step / kStepsPerRepeat, earliest = block == 0 ? kLeastStepsBetween : 0;
  const std::uint64_t places = static_cast<std::uint64_t>(kStepsPerRepeat - earliest);
  const std::uint64_t place = chance(seed_, Purpose::kWhenToRepeat, block) % places;
  return step % kStepsPerRepeat == earliest + static_cast<int>(place);
}

std::optional<LabelTarget> LabellingSession::to_repeat() const {
  std::optional<LabelTarget> best;
  std::tuple<int, std::uint64_t> least{std::numeric_limits<int>::max(), 0};  // fewest labels, then by chance
  for (const auto& [target, showings] : showings_) {
    if (showings.count == 0 || num_labelled() - showings.last_step < kLeastStepsBetween) continue;
    const std::tuple rank{showings.count, chance(seed_, Purpose::kRepeat, num_labelled(), target)};
    if (rank >= least) continue;
    least = rank;
    best = target;
  }
  return best;
}

LabelTarget LabellingSession::to_open() const {
  LabelTarget best;
  std::optional<std::uint64_t> least;
  for (const auto& [target, showings] : showings_) {
    if (showings.count > 0) continue;
    const std::uint64_t rank = chance(seed_, Purpose::kOrder, num_labelled(), target);
    if (least && rank >= *least) continue;
    least = rank;
    best = target;
  }
  return best;
}

std::optional<LabellingItem> LabellingSession::next() const {
  if (is_finished()) return std::nullopt;
  if (is_repeat_step(num_labelled())) {
    if (const auto again = to_repeat()) return LabellingItem{*again, num_labelled(), true};
  }
  return LabellingItem{to_open(), num_labelled(), false};
}

int LabellingSession::num_steps() const {
  int step = num_labelled();
  for (int open = num_open_; open > 0; ++step) open -= is_repeat_step(step) ? 0 : 1;
  return step;
}

std::string LabellingSession::name_of(const LabellingItem& item) const {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(chance(seed_, Purpose::kName, item.step, item.target)));
  return std::to_string(item.step) + "-" + digits.data();
}

std::optional<LabellingItem> LabellingSession::find(const std::string& name) const {
  LabellingItem item;
  const auto read = std::from_chars(name.data(), name.data() + name.size(), item.step);
  if (read.ec != std::errc() || item.step < 0) return std::nullopt;
  if (item.step < num_labelled()) {
    item.target = history_[static_cast<std::size_t>(item.step)];
    const auto before = history_.begin() + item.step;
    item.is_repeat = std::find(history_.begin(), before, item.target) != before;
    return name_of(item) == name ? std::optional(item) : std::nullopt;
  }
  for (const auto& [target, showings] : showings_) {
    item.target = target;
    item.is_repeat = showings.count > 0;
    if (name_of(item) == name) return item;
  }
  return std::nullopt;
}

}  // namespace strut::effort
