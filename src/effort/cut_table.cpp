// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include <strut/core/error.h>
#include <strut/effort/cut_table.h>
#include <strut/io/csv.h>

namespace strut::effort {
namespace {

using motion::FrameRange;

/// What a table says of one clip.
struct ClipCuts {
  ClipRecord clip;
  std::vector<FrameRange> cuts;
  std::vector<std::size_t> lines;  ///< of the cuts
};

int frame_of(const CsvTable& table, const CsvLine& row, std::size_t place, int least, int greatest) {
  const CsvField& field = row.fields[place];
  const double number = csv_number(field, row.line, table.path);
  if (number == std::floor(number) && number >= least && number <= greatest) return static_cast<int>(number);
  throw ParseError(table.path, row.line, field.column,
                   "a frame from " + std::to_string(least) + " to " + std::to_string(greatest), "'" + field.text + "'");
}

std::map<RecordId, ClipCuts> cuts_of(const CsvTable& table, const FragmentDatabase& database) {
  const std::size_t clip = table.place_of("clip"), begin = table.place_of("begin_frame"),
                    end = table.place_of("end_frame");
  const auto performer = table.find("performer"), action = table.find("action");
  std::map<std::string, ClipRecord> clips;
  for (ClipRecord& record : database.clips()) clips.emplace(record.name, record);
  std::map<RecordId, ClipCuts> found;
  for (const CsvLine& row : table.rows) {
    const auto known = clips.find(row.fields[clip].text);
    if (known == clips.end()) {
      throw ParseError(table.path, row.line, row.fields[clip].column, "a clip of the database",
                       "'" + row.fields[clip].text + "'");
    }
    ClipCuts& of = found.try_emplace(known->second.id, ClipCuts{known->second, {}, {}}).first->second;
    if (performer) of.clip.performer = row.fields[*performer].text;
    if (action) of.clip.action = row.fields[*action].text;
    if (row.fields[begin].text.empty() && row.fields[end].text.empty()) continue;
    const int first = frame_of(table, row, begin, 0, of.clip.num_frames - 1);
    const FrameRange range{first, frame_of(table, row, end, first + 1, of.clip.num_frames)};
    for (std::size_t k = 0; k < of.cuts.size(); ++k) {
      if (range.begin < of.cuts[k].end && of.cuts[k].begin < range.end) {
        throw ParseError(table.path, row.line, row.fields[begin].column,
                         "frames that do not overlap those of line " + std::to_string(of.lines[k]),
                         std::to_string(range.begin) + " to " + std::to_string(range.end));
      }
    }
    of.cuts.push_back(range);
    of.lines.push_back(row.line);
  }
  for (auto& [id, of] : found) {
    std::sort(of.cuts.begin(), of.cuts.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  }
  return found;
}

void refuse_losses(const std::string& path, const FragmentDatabase& database,
                   const std::map<RecordId, ClipCuts>& clips) {
  std::string lost;
  for (const auto& [id, of] : clips) {
    for (const FragmentRecord& fragment : database.labelled_without(id, of.cuts)) {
      lost += (lost.empty() ? "" : ", ") + std::to_string(fragment.id) + " (" + fragment.clip_name + " " +
              std::to_string(fragment.frames.begin) + " to " + std::to_string(fragment.frames.end) + ")";
    }
  }
  if (lost.empty()) return;
  throw ParseError(path, 0, 0, "cuts that keep all labelled fragments", "none for fragment " + lost,
                   "keep their frames, or use --discard-labels");
}

std::string seconds(int frames, double rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", frames / rate);
  return text;
}

}  // namespace

std::string format_cuts(const FragmentDatabase& database) {
  std::map<RecordId, std::vector<FragmentRecord>> by_clip;
  for (FragmentRecord& fragment : database.fragments()) by_clip[fragment.clip].push_back(std::move(fragment));
  std::string text = "clip,begin_frame,end_frame,seconds,fragment,performer,action\n";
  for (const ClipRecord& clip : database.clips()) {
    const std::string who = "," + csv_field(clip.performer) + "," + csv_field(clip.action) + "\n";
    if (by_clip[clip.id].empty()) text += csv_field(clip.name) + ",,,," + who;
    for (const FragmentRecord& fragment : by_clip[clip.id]) {
      text += csv_field(clip.name) + "," + std::to_string(fragment.frames.begin) + "," +
              std::to_string(fragment.frames.end) + "," + seconds(fragment.frames.num_frames(), database.frame_rate()) +
              "," + std::to_string(fragment.id) + who;
    }
  }
  return text;
}

int import_cuts(FragmentDatabase& database, const std::string& path, OnLabels labels) {
  const CsvTable table = read_csv(path);
  FragmentDatabase::Transaction transaction(database);
  const std::map<RecordId, ClipCuts> clips = cuts_of(table, database);
  if (labels == OnLabels::kRefuse) refuse_losses(path, database, clips);
  for (const auto& [id, of] : clips) {
    database.set_cuts(id, of.cuts, CutSource::kPerson, labels);
    database.describe_clip(id, of.clip.performer, of.clip.action);
  }
  transaction.commit();
  return static_cast<int>(clips.size());
}

}  // namespace strut::effort
