// SPDX-License-Identifier: MIT
#include "view/label_answer.h"

#include "view/clip_answer.h"
#include "view/page_server.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <vector>

#include <fmt/chrono.h>

#include <strut/core/error.h>
#include <strut/effort/labelled_movement.h>
#include <strut/effort/rater_consistency.h>

namespace strut::cli {
namespace {

using effort::LabellingItem;
using effort::LabellingSession;
using effort::LabelRecord;
using effort::LabelTarget;
using effort::TargetKind;
using Json = LabelDesk::Json;
using Clock = std::chrono::system_clock;

constexpr int kNotFound = 404;
constexpr const char* kShownAs = "fragment";  // whatever it is and whatever its clip is called

/// Without the blanks around it.
std::string name_in(const std::string& rater) {
  constexpr const char* kBlanks = " \t\r\n";
  const auto begin = rater.find_first_not_of(kBlanks);
  if (begin == std::string::npos) throw Refusal{400, "labels need a rater's name", "say who labels"};
  return rater.substr(begin, rater.find_last_not_of(kBlanks) - begin + 1);
}

/// ISO 8601, UTC, to the millisecond.
std::string in_words(Clock::time_point moment) {
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(moment.time_since_epoch()).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(Clock::to_time_t(moment)), since % 1000);
}

std::size_t factor_called(const std::string& name) {
  const auto found = std::find(effort::kFactorNames.begin(), effort::kFactorNames.end(), name);
  if (found == effort::kFactorNames.end()) throw Refusal{400, "there is no factor '" + name + "'", {}};
  return static_cast<std::size_t>(found - effort::kFactorNames.begin());
}

LabelRecord label_in(const Json& said, const LabellingItem& item, const std::string& rater) {
  LabelRecord label;
  label.target = item.target;
  label.rater = rater;
  label.is_repeat = item.is_repeat;
  for (const auto& [name, value] : said.at("rating").items()) {
    const std::size_t factor = factor_called(name);
    if (!value.is_null()) label.rating[static_cast<Eigen::Index>(factor)] = value.get<double>();
  }
  for (const Json& name : said.at("notPresent")) label.not_present.at(factor_called(name.get<std::string>())) = true;
  label.comment = said.value("comment", std::string());
  return label;
}

/// Stores it as of now. Two labels of one thing at one moment would count as one, so the second is a moment later.
void add_now(effort::FragmentDatabase& database, LabelRecord label) {
  Clock::time_point now = Clock::now();
  do {
    label.labelled_at = in_words(now);
    now += std::chrono::milliseconds(1);
  } while (database.add_labels({label}) == 0);
}

Json consistency_of(const effort::FragmentDatabase& database, const std::string& rater) {
  const effort::RaterConsistency consistency = effort::rater_consistency(database.labels(), rater);
  Json factors = Json::array();
  for (int k = 0; k < effort::kNumFactors; ++k) {
    if (consistency.num_compared[k] == 0) continue;
    factors.push_back({{"factor", effort::kFactorNames.at(static_cast<std::size_t>(k))},
                       {"compared", consistency.num_compared[k]},
                       {"meanDifference", consistency.mean_difference[k]}});
  }
  return {{"repeats", consistency.num_repeats}, {"factors", factors}};
}

Json name_or_null(const LabellingSession& session, const std::optional<LabellingItem>& item) {
  return item ? Json(session.name_of(*item)) : Json(nullptr);
}

}  // namespace

effort::FragmentDatabase& LabelDesk::opened(effort::Access access) {
  if (!database_ || (access == effort::Access::kReadWrite && access_ != access)) {
    database_ = effort::FragmentDatabase::open(path_, access);
    access_ = access;
  }
  return *database_;
}

LabellingSession LabelDesk::session_of(const std::string& rater) {
  const effort::FragmentDatabase& database = opened(effort::Access::kRead);
  std::vector<LabelTarget> targets;
  for (const auto& fragment : database.fragments()) targets.push_back({TargetKind::kFragment, fragment.id});
  for (const auto& blend : database.blends()) targets.push_back({TargetKind::kBlend, blend.id});
  std::erase_if(targets, [&](const LabelTarget& target) { return left_out_.count(target) > 0; });
  return {rater, targets, effort::labelled_by(database.labels(), rater)};
}

std::optional<LabellingItem> LabelDesk::next_that_moves(LabellingSession& session) {
  while (const auto item = session.next()) {
    try {
      effort::labelled_movement(*database_, item->target);
      return item;
    } catch (const InvalidArgument& error) {
      left_out_[item->target] = error.what();
    } catch (const SkeletonMismatch& error) {
      left_out_[item->target] = error.what();
    }
    session.leave_out(item->target);
  }
  return std::nullopt;
}

Json LabelDesk::progress_now(const std::string& rater) {
  LabellingSession session = session_of(rater);
  const auto next = next_that_moves(session);
  LabellingSession ahead = session;
  if (next) ahead.record(next->target);
  const auto after_next = next_that_moves(ahead);
  Json progress{{"rater", rater},
                {"done", session.num_labelled()},
                {"total", ahead.num_steps()},
                {"next", name_or_null(session, next)},
                {"afterNext", name_or_null(session, after_next)},
                {"notes", Json::array()}};
  for (const auto& [target, why] : left_out_) {
    const std::string message = fmt::format("blend {} cannot be made and is left out: {}", target.id, why);
    progress["notes"].push_back({{"message", message}});
  }
  if (!next) progress["consistency"] = consistency_of(*database_, rater);
  return progress;
}

Json LabelDesk::progress(const std::string& rater) {
  const std::scoped_lock lock(mutex_);
  return progress_now(name_in(rater));
}

Container LabelDesk::movement(const std::string& rater, const std::string& item) {
  const std::scoped_lock lock(mutex_);
  const auto found = session_of(name_in(rater)).find(item);
  if (!found) throw Refusal{kNotFound, "there is no such movement to label any more", "reload the page"};
  return clip_answer(item, kShownAs, effort::labelled_movement(*database_, found->target));
}

Json LabelDesk::store(const Json& said) {
  const std::scoped_lock lock(mutex_);
  const std::string rater = name_in(said.at("rater").get<std::string>());
  effort::FragmentDatabase& database = opened(effort::Access::kReadWrite);
  const char* stored = "no";
  {
    // Nobody else writes between looking where the rater stands and storing.
    effort::FragmentDatabase::Transaction transaction(database);
    const LabellingSession session = session_of(rater);
    const auto item = session.find(said.at("item").get<std::string>());
    if (item && item->step < session.num_labelled()) stored = "before";
    if (item && item->step == session.num_labelled()) {
      add_now(database, label_in(said, *item, rater));
      transaction.commit();
      stored = "now";
    }
  }
  Json progress = progress_now(rater);
  progress["stored"] = stored;
  return progress;
}

Json LabelDesk::undo(const Json& said) {
  const std::scoped_lock lock(mutex_);
  const std::string rater = name_in(said.at("rater").get<std::string>());
  const int done = said.at("done").get<int>();
  effort::FragmentDatabase& database = opened(effort::Access::kReadWrite);
  {
    effort::FragmentDatabase::Transaction transaction(database);
    if (session_of(rater).num_labelled() == done) database.remove_last_label(rater);
    transaction.commit();
  }
  return progress_now(rater);
}

}  // namespace strut::cli
