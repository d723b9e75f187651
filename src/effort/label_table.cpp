// SPDX-License-Identifier: MIT
#include "effort/label_checks.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include <strut/core/error.h>
#include <strut/effort/label_table.h>
#include <strut/io/csv.h>

namespace strut::effort {
namespace {

constexpr const char* kNotPresent = "not present";

std::string shortest(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

/// Reads the rows of one table against one database.
class LabelReader {
 public:
  LabelReader(const CsvTable& table, const FragmentDatabase& database) : table_(table) {
    for (FragmentRecord& fragment : database.fragments()) {
      by_frames_[{fragment.clip_name, fragment.frames.begin, fragment.frames.end}] = fragment.id;
      ids_.insert(fragment.id);
    }
    for (const PairRecord& pair : database.accepted_pairs()) pairs_.insert({pair.first, pair.second});
    (void)table_.place_of("rater");
    (void)table_.place_of("labelled_at");
  }

  /// The label of a row; a blend's target is added to the database.
  LabelRecord label(const CsvLine& row, FragmentDatabase& database) const {
    LabelRecord label;
    label.target = target(row, database);
    label.rater = text(row, "rater");
    label.labelled_at = text(row, "labelled_at");
    label.source = source(row);
    label.comment = text(row, "comment");
    const std::string repeat = text(row, "repeat");
    if (!repeat.empty() && repeat != "0" && repeat != "1") fail(row, "repeat", "0 or 1", "'" + repeat + "'");
    label.is_repeat = repeat == "1";
    for (std::size_t k = 0; k < kNumFactors; ++k) rate(row, k, label);
    try {
      check_label(label);
    } catch (const InvalidArgument& error) {
      const std::string said = error.what();
      const auto comma = said.rfind(", got "), begin = error.argument().size() + sizeof(": expected ") - 1;
      fail(row, error.argument(), said.substr(begin, comma - begin), said.substr(comma + 6));
    }
    return label;
  }
  [[nodiscard]] bool is_estimate(const CsvLine& row) const { return text(row, "source") == "estimate"; }

 private:
  [[nodiscard]] const CsvField* field(const CsvLine& row, const std::string& name) const {
    const auto place = table_.find(name);
    return place ? &row.fields[*place] : nullptr;
  }
  [[nodiscard]] std::string text(const CsvLine& row, const std::string& name) const {
    const CsvField* found = field(row, name);
    return found == nullptr ? std::string() : found->text;
  }
  [[noreturn]] void fail(const CsvLine& row, const std::string& name, const std::string& expected,
                         const std::string& got, const std::string& hint = {}) const {
    const CsvField* found = field(row, name);
    throw ParseError(table_.path, row.line, found == nullptr ? 0 : found->column, expected, got, hint);
  }

  [[nodiscard]] RecordId whole(const CsvLine& row, const std::string& name) const {
    const CsvField* found = field(row, name);
    if (found == nullptr) fail(row, name, "a column '" + name + "'", "none");
    const double number = csv_number(*found, row.line, table_.path);
    if (number != std::floor(number) || std::abs(number) > 1e15) {
      fail(row, name, "a whole number", "'" + found->text + "'");
    }
    return static_cast<RecordId>(number);
  }
  [[nodiscard]] RecordId fragment(const CsvLine& row, const std::string& name) const {
    const RecordId id = whole(row, name);
    if (ids_.count(id) == 0) {
      fail(row, name, "a fragment of the database", std::to_string(id), "strut effort labels --export lists them");
    }
    return id;
  }

  LabelTarget target(const CsvLine& row, FragmentDatabase& database) const {
    if (!text(row, "first").empty() || !text(row, "second").empty()) return blend(row, database);
    if (!text(row, "fragment").empty()) return {TargetKind::kFragment, fragment(row, "fragment")};
    if (text(row, "clip").empty()) fail(row, "fragment", "a fragment, a clip with frames, or a blend", "none");
    const auto found = by_frames_.find({text(row, "clip"), whole(row, "begin_frame"), whole(row, "end_frame")});
    if (found == by_frames_.end()) {
      fail(row, "clip", "a fragment of the database",
           "'" + text(row, "clip") + "' " + text(row, "begin_frame") + " to " + text(row, "end_frame"));
    }
    return {TargetKind::kFragment, found->second};
  }

  LabelTarget blend(const CsvLine& row, FragmentDatabase& database) const {
    const RecordId first = fragment(row, "first"), second = fragment(row, "second");
    const CsvField* found = field(row, "alpha");
    if (found == nullptr) fail(row, "alpha", "a column 'alpha'", "none");
    const double alpha = csv_number(*found, row.line, table_.path);
    if (!database.find_blend(first, second, alpha) &&
        pairs_.count({std::min(first, second), std::max(first, second)}) == 0) {
      fail(row, "first", "an accepted pair", std::to_string(first) + " and " + std::to_string(second),
           "strut effort match accepts pairs");
    }
    return {TargetKind::kBlend, database.add_blend(first, second, alpha)};
  }

  LabelSource source(const CsvLine& row) const {
    const std::string word = text(row, "source");
    if (word.empty() || word == "person") return LabelSource::kPerson;
    if (word != "synthetic") fail(row, "source", "person, synthetic or estimate", "'" + word + "'");
    return LabelSource::kSynthetic;
  }

  void rate(const CsvLine& row, std::size_t factor, LabelRecord& label) const {
    const CsvField* found = field(row, kFactorNames[factor]);
    if (found == nullptr || found->text.empty()) return;
    label.not_present[factor] = found->text == kNotPresent;
    if (!label.not_present[factor]) {
      label.rating[static_cast<Eigen::Index>(factor)] = csv_number(*found, row.line, table_.path);
    }
  }

  const CsvTable& table_;
  std::map<std::tuple<std::string, RecordId, RecordId>, RecordId> by_frames_;
  std::set<RecordId> ids_;
  std::set<std::pair<RecordId, RecordId>> pairs_;
};

/// The columns up to the rater's.
std::string target_columns(const LabelTarget& target, const std::map<RecordId, FragmentRecord>& fragments,
                           const std::map<RecordId, BlendRecord>& blends) {
  if (target.kind == TargetKind::kBlend) {
    const BlendRecord& blend = blends.at(target.id);
    return ",,,," + std::to_string(blend.first) + "," + std::to_string(blend.second) + "," + shortest(blend.alpha);
  }
  const FragmentRecord& fragment = fragments.at(target.id);
  return std::to_string(fragment.id) + "," + csv_field(fragment.clip_name) + "," +
         std::to_string(fragment.frames.begin) + "," + std::to_string(fragment.frames.end) + ",,,";
}

std::string rated(const LabelRecord& label) {
  std::string columns;
  for (std::size_t k = 0; k < kNumFactors; ++k) {
    const double value = label.rating[static_cast<Eigen::Index>(k)];
    columns += "," + (label.not_present[k] ? kNotPresent : is_rated(value) ? shortest(value) : std::string());
  }
  return columns;
}

}  // namespace

LabelImport import_labels(FragmentDatabase& database, const std::string& path) {
  const CsvTable table = read_csv(path);
  const LabelReader reader(table, database);
  FragmentDatabase::Transaction transaction(database);
  LabelImport result;
  std::vector<LabelRecord> labels;
  for (const CsvLine& row : table.rows) {
    if (reader.is_estimate(row)) {
      ++result.estimates;
    } else {
      labels.push_back(reader.label(row, database));
    }
  }
  result.added = database.add_labels(labels);
  result.repeated = static_cast<int>(labels.size()) - result.added;
  transaction.commit();
  return result;
}

std::string format_labels(const FragmentDatabase& database, bool with_estimates) {
  std::map<RecordId, FragmentRecord> fragments;
  for (FragmentRecord& fragment : database.fragments()) fragments.emplace(fragment.id, std::move(fragment));
  std::map<RecordId, BlendRecord> blends;
  for (const BlendRecord& blend : database.blends()) blends.emplace(blend.id, blend);
  std::string text =
      "fragment,clip,begin_frame,end_frame,first,second,alpha,rater,labelled_at,source,flow,weight,time,space,repeat,"
      "comment\n";
  for (const LabelRecord& label : database.labels()) {
    text += target_columns(label.target, fragments, blends) + "," + csv_field(label.rater) + "," + label.labelled_at +
            (label.source == LabelSource::kPerson ? ",person" : ",synthetic") + rated(label) +
            (label.is_repeat ? ",1," : ",0,") + csv_field(label.comment) + "\n";
  }
  if (!with_estimates) return text;
  for (const EstimateRecord& estimate : database.estimates()) {
    LabelRecord values;
    values.rating.head<kNumPredictedFactors>() = estimate.effort;
    text += target_columns({TargetKind::kFragment, estimate.fragment}, fragments, blends) + ",,,estimate" +
            rated(values) + ",,\n";
  }
  return text;
}

}  // namespace strut::effort
