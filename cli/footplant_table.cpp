// SPDX-License-Identifier: MIT
#include "footplant_table.h"

#include "csv_table.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/io/csv.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::cli {
namespace {

using motion::Footplant;

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (const auto& part : std::filesystem::path(path).lexically_normal()) {
    if (part != ".." && part != ".") parts.push_back(part.string());
  }
  return parts;
}

/// Whether the shorter of two paths is how the longer one ends.
bool ends_alike(const std::string& a, const std::string& b) {
  const auto in_a = parts_of(a), in_b = parts_of(b);
  const auto count = static_cast<std::ptrdiff_t>(std::min(in_a.size(), in_b.size()));
  return std::equal(in_a.end() - count, in_a.end(), in_b.end() - count, in_b.end());
}

class TableReader {
 public:
  TableReader(const std::string& path, const PairedClips& clips) : path_(path), clips_(clips) {}

  /// The output clip that `row` speaks of, or none.
  [[nodiscard]] std::optional<std::size_t> clip_of(const CsvRow& row) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < clips_.output_paths.size(); ++i) {
      if (clips_.output_paths[i] == row.texts[0]) return i;
      if (ends_alike(clips_.output_paths[i], row.texts[0])) found.push_back(i);
    }
    if (found.empty()) return std::nullopt;
    if (found.size() == 1) return found.front();
    throw ParseError(path_, row.line, row.text_columns[0], "the name of one clip",
                     fmt::format("'{}', which may be {} or {}", row.texts[0], clips_.output_paths[found[0]],
                                 clips_.output_paths[found[1]]),
                     "write more of its path");
  }

  [[nodiscard]] Footplant footplant_of(const CsvRow& row, int num_frames) const {
    Footplant plant{0, frame_of(row, 0, 0, num_frames - 1), 0};
    plant.end = frame_of(row, 1, plant.begin + 1, num_frames);
    if (row.texts[1] == "left") return plant;
    if (row.texts[1] != "right") {
      throw ParseError(path_, row.line, row.text_columns[1], "left or right", "'" + row.texts[1] + "'");
    }
    plant.foot = 1;
    return plant;
  }

 private:
  [[nodiscard]] int frame_of(const CsvRow& row, std::size_t number, int least, int greatest) const {
    const double value = row.numbers[number];
    if (value == std::floor(value) && value >= least && value <= greatest) return static_cast<int>(value);
    throw ParseError(path_, row.line, row.number_columns[number], fmt::format("a frame from {} to {}", least, greatest),
                     fmt::format("{:g}", value));
  }

  const std::string& path_;
  const PairedClips& clips_;
};

std::vector<Footplant> detected(const Motion& clip) {
  const auto legs = motion::find_legs(clip);
  return legs ? postprocess::detect_footplants(clip, *legs) : std::vector<Footplant>{};
}

}  // namespace

const char* foot_name(int foot) {
  return foot == 0 ? "left" : "right";
}

std::string format_footplants(const std::vector<ClipFootplants>& clips) {
  std::string table = "clip,foot,begin,end,begin_s,end_s\n";
  for (const ClipFootplants& clip : clips) {
    for (const Footplant& plant : clip.footplants) {
      table += fmt::format("{},{},{},{},{:.4f},{:.4f}\n", csv_field(clip.path), foot_name(plant.foot), plant.begin,
                           plant.end, plant.begin / clip.frame_rate, plant.end / clip.frame_rate);
    }
  }
  return table;
}

std::vector<std::vector<Footplant>> read_footplants(const std::string& path, const PairedClips& clips,
                                                    Diagnostics& diagnostics) {
  const TableReader reader(path, clips);
  std::vector<std::optional<std::vector<Footplant>>> found(clips.outputs.size());
  std::set<std::string> others;
  for (const CsvRow& row : read_csv_rows(path, {"clip", "foot"}, {"begin", "end"})) {
    const auto clip = reader.clip_of(row);
    if (!clip) {
      others.insert(row.texts[0]);
      continue;
    }
    if (!found[*clip]) found[*clip].emplace();
    found[*clip]->push_back(reader.footplant_of(row, clips.outputs[*clip].num_frames()));
  }
  for (const std::string& other : others) {
    diagnostics.note(path, fmt::format("'{}' is no output clip of the pair list: its footplants are not used", other));
  }
  if (std::none_of(found.begin(), found.end(), [](const auto& plants) { return plants.has_value(); })) {
    throw ParseError(path, 0, 0, "footplants of the pair list's output clips", "none");
  }
  std::vector<std::vector<Footplant>> all;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) diagnostics.note(path, clips.output_paths[i] + " is not in it: its footplants are detected");
    all.push_back(found[i] ? *found[i] : detected(clips.outputs[i]));
  }
  return all;
}

}  // namespace strut::cli
