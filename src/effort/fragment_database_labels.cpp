// SPDX-License-Identifier: MIT
// What is known of a fragment database's fragments: which can be blended, what people say of them and of blends, and,
// in a table of its own that no function for labels reads, what was estimated.
#include "effort/fragment_database_parts.h"
#include "effort/label_checks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <strut/core/error.h>
#include <strut/effort/fragment_database.h>

namespace strut::effort {
namespace {

[[noreturn]] void refuse_fragment(const char* argument, RecordId id) {
  throw InvalidArgument(argument, "the id of a fragment", std::to_string(id));
}

void check_known(const char* argument, const std::set<RecordId>& known, RecordId id) {
  if (known.count(id) == 0) refuse_fragment(argument, id);
}

void check_two(const std::set<RecordId>& known, RecordId first, RecordId second) {
  check_known("first", known, first);
  check_known("second", known, second);
  if (first == second) throw InvalidArgument("second", "another fragment than the first", std::to_string(second));
}

bool is_persons(PairStatus status) {
  return status == PairStatus::kAcceptedByPerson || status == PairStatus::kRejectedByPerson;
}

void write_decision(const Connection& connection, RecordId first, RecordId second, bool accepted) {
  connection.prepare("INSERT OR REPLACE INTO decisions VALUES(?, ?, ?)")
      .bind(0, std::min(first, second))
      .bind(1, std::max(first, second))
      .bind(2, accepted ? 1 : 0)
      .run();
}

void write_pairs(const Connection& connection, const std::vector<PairRecord>& pairs, const std::set<RecordId>& known) {
  Statement row = connection.prepare("INSERT OR REPLACE INTO pairs VALUES(?, ?, ?, ?, ?)");
  for (const PairRecord& pair : pairs) {
    check_two(known, pair.first, pair.second);
    if (pair.first > pair.second) throw InvalidArgument("pairs", "the smaller id first", std::to_string(pair.first));
    if (is_persons(pair.status)) write_decision(connection, pair.first, pair.second, pair.is_accepted());
    row.bind(0, pair.first).bind(1, pair.second).bind(2, pair.cost).bind(3, pair.share_at_limit);
    row.bind(4, pair.is_accepted() ? 1 : 0).run();
  }
}

// Compared pairs with what people say of them, then pairs that people alone name.
constexpr const char* kPairs =
    "SELECT p.first, p.second, p.cost, p.share_at_limit, p.accepted, d.accepted FROM pairs p LEFT JOIN decisions d "
    "ON d.first = p.first AND d.second = p.second UNION ALL SELECT d.first, d.second, NULL, NULL, 0, d.accepted FROM "
    "decisions d WHERE NOT EXISTS (SELECT 1 FROM pairs p WHERE p.first = d.first AND p.second = d.second) "
    "ORDER BY 1, 2";

PairStatus status_of(const Statement& row) {
  if (!row.is_null(5)) return row.integer(5) != 0 ? PairStatus::kAcceptedByPerson : PairStatus::kRejectedByPerson;
  return row.integer(4) != 0 ? PairStatus::kAccepted : PairStatus::kRejected;
}

BlendRecord blend_of(const Statement& row) {
  return {row.integer(0), row.integer(1), row.integer(2), row.number(3)};
}

/// A blend as it is kept, whichever way it is told. What one minus a decimal leaves in the last digits is taken off.
BlendRecord in_order(RecordId first, RecordId second, double alpha) {
  constexpr double kDigits = 1e12;
  if (first < second) return {0, first, second, alpha};
  return {0, second, first, std::round((1.0 - alpha) * kDigits) / kDigits};
}

int as_bits(const std::array<bool, kNumFactors>& flags) {
  int bits = 0;
  for (std::size_t k = 0; k < flags.size(); ++k) bits |= flags[k] ? 1 << k : 0;
  return bits;
}

void check_target(const LabelTarget& target, const std::set<RecordId>& fragments, const std::set<RecordId>& blends) {
  const bool is_blend = target.kind == TargetKind::kBlend;
  if ((is_blend ? blends : fragments).count(target.id) > 0) return;
  throw InvalidArgument("target", is_blend ? "the id of a blend" : "the id of a fragment", std::to_string(target.id));
}

constexpr const char* kLabels =
    "SELECT id, fragment, blend, rater, labelled_at, source, flow, weight, time, space, not_present, repeat, comment "
    "FROM labels ";

LabelRecord label_of(const Statement& row) {
  LabelRecord label;
  label.id = row.integer(0);
  label.target = row.is_null(1) ? LabelTarget{TargetKind::kBlend, row.integer(2)}
                                : LabelTarget{TargetKind::kFragment, row.integer(1)};
  label.rater = row.text(3);
  label.labelled_at = row.text(4);
  label.source = row.text(5) == "person" ? LabelSource::kPerson : LabelSource::kSynthetic;
  for (int k = 0; k < kNumFactors; ++k) {
    label.rating[k] = row.number(6 + k);
    label.not_present[static_cast<std::size_t>(k)] = (row.integer(10) >> k & 1) != 0;
  }
  label.is_repeat = row.integer(11) != 0;
  label.comment = row.text(12);
  return label;
}

/// One rater's labels of one target.
struct RaterSum {
  Rating sum = Rating::Zero();
  Eigen::Vector4i count = Eigen::Vector4i::Zero();
  int labels = 0;
};

MeanLabel mean_of(const LabelTarget& target, const std::map<std::string, RaterSum>& raters) {
  MeanLabel mean;
  mean.target = target;
  Rating sum = Rating::Zero();
  for (const auto& [rater, of] : raters) {
    mean.raters.push_back({rater, of.labels});
    for (int k = 0; k < kNumFactors; ++k) {
      if (of.count[k] == 0) continue;
      sum[k] += of.sum[k] / of.count[k];
      ++mean.num_raters[k];
    }
  }
  for (int k = 0; k < kNumFactors; ++k) {
    if (mean.num_raters[k] > 0) mean.mean[k] = sum[k] / mean.num_raters[k];
  }
  return mean;
}

void check_estimate(const EstimateRecord& estimate, const std::set<RecordId>& known) {
  check_known("estimates", known, estimate.fragment);
  for (int k = 0; k < kNumPredictedFactors; ++k) {
    if (std::abs(estimate.effort[k]) > 1.0) {
      throw InvalidArgument("estimates", "values from -1 to 1", std::to_string(estimate.effort[k]));
    }
    if (!(estimate.confidence[k] >= 0.0 && estimate.confidence[k] <= 1.0)) {
      throw InvalidArgument("estimates", "confidences from 0 to 1", std::to_string(estimate.confidence[k]));
    }
  }
}

}  // namespace

void FragmentDatabase::set_matching(const std::vector<GroupOf>& groups, const std::vector<PairRecord>& pairs) {
  Connection& connection = parts_->connection;
  Change change(connection);
  const std::set<RecordId> known = parts_->ids_of("fragments");
  connection.execute("UPDATE fragments SET content = NULL; DELETE FROM pairs");
  Statement row = connection.prepare("UPDATE fragments SET content = ? WHERE id = ?");
  for (const auto& [fragment, group] : groups) {
    check_known("groups", known, fragment);
    if (group < 0) continue;
    row.bind(0, group).bind(1, fragment).run();
  }
  write_pairs(connection, pairs, known);
  change.commit();
}

void FragmentDatabase::decide_pair(RecordId one, RecordId other, bool accepted) {
  Change change(parts_->connection);
  check_two(parts_->ids_of("fragments"), one, other);
  write_decision(parts_->connection, one, other, accepted);
  change.commit();
}

std::vector<PairRecord> FragmentDatabase::pairs() const {
  std::vector<PairRecord> pairs;
  Statement rows = parts_->connection.prepare(kPairs);
  while (rows.next()) {
    pairs.push_back({rows.integer(0), rows.integer(1), rows.number(2), rows.number(3), status_of(rows)});
  }
  return pairs;
}

std::vector<PairRecord> FragmentDatabase::accepted_pairs() const {
  std::vector<PairRecord> accepted = pairs();
  std::erase_if(accepted, [](const PairRecord& pair) { return !pair.is_accepted(); });
  return accepted;
}

RecordId FragmentDatabase::add_blend(RecordId first, RecordId second, double alpha) {
  if (!std::isfinite(alpha)) throw InvalidArgument("alpha", "a finite number", std::to_string(alpha));
  Change change(parts_->connection);
  check_two(parts_->ids_of("fragments"), first, second);
  if (const auto known = find_blend(first, second, alpha)) return known->id;
  const BlendRecord blend = in_order(first, second, alpha);
  parts_->connection.prepare("INSERT INTO blends(first, second, alpha) VALUES(?, ?, ?)")
      .bind(0, blend.first)
      .bind(1, blend.second)
      .bind(2, blend.alpha)
      .run();
  const RecordId id = parts_->connection.last_id();
  change.commit();
  return id;
}

std::optional<BlendRecord> FragmentDatabase::find_blend(RecordId first, RecordId second, double alpha) const {
  const BlendRecord blend = in_order(first, second, alpha);
  Statement row = parts_->connection.prepare(
      "SELECT id, first, second, alpha FROM blends WHERE first = ? AND second = ? AND abs(alpha - ?) < 1e-9");
  row.bind(0, blend.first).bind(1, blend.second).bind(2, blend.alpha);
  return row.next() ? std::optional(blend_of(row)) : std::nullopt;
}

std::vector<BlendRecord> FragmentDatabase::blends() const {
  std::vector<BlendRecord> blends;
  Statement rows = parts_->connection.prepare("SELECT id, first, second, alpha FROM blends ORDER BY id");
  while (rows.next()) blends.push_back(blend_of(rows));
  return blends;
}

int FragmentDatabase::add_labels(const std::vector<LabelRecord>& labels) {
  Connection& connection = parts_->connection;
  Change change(connection);
  const std::set<RecordId> fragments = parts_->ids_of("fragments"), blends = parts_->ids_of("blends");
  Statement row = connection.prepare(
      "INSERT INTO labels(fragment, blend, rater, labelled_at, source, flow, weight, time, space, not_present, repeat, "
      "comment) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING");
  int added = 0;
  for (const LabelRecord& label : labels) {
    check_target(label.target, fragments, blends);
    check_label(label);
    const bool is_blend = label.target.kind == TargetKind::kBlend;
    row.bind_null(is_blend ? 0 : 1).bind(is_blend ? 1 : 0, label.target.id);
    row.bind(2, label.rater).bind(3, label.labelled_at);
    row.bind(4, label.source == LabelSource::kPerson ? "person" : "synthetic");
    for (int k = 0; k < kNumFactors; ++k) row.bind(5 + k, label.rating[k]);
    row.bind(9, as_bits(label.not_present)).bind(10, label.is_repeat ? 1 : 0).bind(11, label.comment).run();
    added += connection.changes();
  }
  change.commit();
  return added;
}

std::optional<LabelRecord> FragmentDatabase::remove_last_label(const std::string& rater) {
  Change change(parts_->connection);
  std::optional<LabelRecord> last;
  {
    Statement row = parts_->connection.prepare(std::string(kLabels) +
                                               "WHERE rater = ? AND source = 'person' ORDER BY id DESC LIMIT 1");
    if (row.bind(0, rater).next()) last = label_of(row);
  }
  if (!last) return std::nullopt;
  parts_->connection.prepare("DELETE FROM labels WHERE id = ?").bind(0, last->id).run();
  change.commit();
  return last;
}

std::vector<LabelRecord> FragmentDatabase::labels() const {
  std::vector<LabelRecord> labels;
  Statement rows = parts_->connection.prepare(std::string(kLabels) + "ORDER BY id");
  while (rows.next()) labels.push_back(label_of(rows));
  return labels;
}

std::vector<MeanLabel> FragmentDatabase::mean_labels(const std::string& rater) const {
  std::map<LabelTarget, std::map<std::string, RaterSum>> sums;
  for (const LabelRecord& label : labels()) {
    if (rater.empty() ? label.source != LabelSource::kPerson : label.rater != rater) continue;
    RaterSum& sum = sums[label.target][label.rater];
    ++sum.labels;
    for (int k = 0; k < kNumFactors; ++k) {
      if (!is_rated(label.rating[k])) continue;
      sum.sum[k] += label.rating[k];
      ++sum.count[k];
    }
  }
  std::vector<MeanLabel> means;
  for (const auto& [target, raters] : sums) means.push_back(mean_of(target, raters));
  return means;
}

void FragmentDatabase::set_estimates(const std::vector<EstimateRecord>& estimates) {
  Change change(parts_->connection);
  const std::set<RecordId> known = parts_->ids_of("fragments");
  parts_->connection.execute("DELETE FROM estimates");
  Statement row = parts_->connection.prepare("INSERT OR REPLACE INTO estimates VALUES(?, ?, ?, ?, ?, ?, ?)");
  for (const EstimateRecord& estimate : estimates) {
    check_estimate(estimate, known);
    row.bind(0, estimate.fragment);
    for (int k = 0; k < kNumPredictedFactors; ++k) {
      row.bind(1 + k, estimate.effort[k]).bind(4 + k, estimate.confidence[k]);
    }
    row.run();
  }
  change.commit();
}

std::vector<EstimateRecord> FragmentDatabase::estimates() const {
  std::vector<EstimateRecord> estimates;
  Statement rows = parts_->connection.prepare(
      "SELECT fragment, flow, weight, time, flow_confidence, weight_confidence, time_confidence FROM estimates "
      "ORDER BY fragment");
  while (rows.next()) {
    estimates.push_back({rows.integer(0),
                         {rows.number(1), rows.number(2), rows.number(3)},
                         {rows.number(4), rows.number(5), rows.number(6)}});
  }
  return estimates;
}

}  // namespace strut::effort
