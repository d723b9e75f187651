// SPDX-License-Identifier: MIT
// Any text as a table of labels and as a table of cuts, read into a small database: it is taken in or refused with a
// ParseError, nothing else. What was taken in is written again and must read as the same labels and the same cuts.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <unistd.h>

#include <strut/core/error.h>
#include <strut/effort/cut_table.h>
#include <strut/effort/label_table.h>

namespace {

using namespace strut;
using effort::FragmentDatabase;

void require(bool holds) {
  if (!holds) std::abort();
}

/// A folder of this process with a database of two clips, two accepted pairs and a blend; removed at the end.
class Place {
 public:
  Place()
      : folder_(std::filesystem::temp_directory_path() / ("label_table_fuzz-" + std::to_string(::getpid()))),
        database_(made(folder_)) {}
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  FragmentDatabase& database() { return database_; }
  /// A file with this text.
  std::string table(std::string_view text) const {
    const std::string path = (folder_ / "table.csv").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

 private:
  static FragmentDatabase made(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const auto skeleton = std::make_shared<const Skeleton>(
        std::vector<Joint>{{"hips", -1, {0.0, 0.9, 0.0}}, {"head", 0, {0.0, 0.8, 0.0}}});
    const Motion motion(skeleton, 30.0, std::vector<Pose>(40, rest_pose(*skeleton)));
    auto database = FragmentDatabase::create((folder / "moves.db").string(), skeleton, 30.0);
    database.add_clip({"a.bvh", "ann", "walk"}, motion, {{0, 10}, {10, 20}, {25, 40}});
    database.add_clip({"b, \"b\".bvh", "", ""}, motion, {{5, 30}});
    database.set_matching(
        {}, {{1, 2, 0.1, 0.0, effort::PairStatus::kAccepted}, {2, 4, 0.1, 0.0, effort::PairStatus::kAccepted}});
    database.add_blend(1, 2, 0.5);
    return database;
  }

  std::filesystem::path folder_;
  FragmentDatabase database_;
};

void take_labels(Place& place, std::string_view text) {
  // Never committed: every input finds the same database.
  const FragmentDatabase::Transaction transaction(place.database());
  try {
    effort::import_labels(place.database(), place.table(text));
  } catch (const ParseError&) {
    return;
  }
  const std::string written = effort::format_labels(place.database(), true);
  require(effort::import_labels(place.database(), place.table(written)).added == 0);
  require(effort::format_labels(place.database(), true) == written);
}

void take_cuts(Place& place, std::string_view text) {
  const FragmentDatabase::Transaction transaction(place.database());
  try {
    effort::import_cuts(place.database(), place.table(text), effort::OnLabels::kDiscard);
  } catch (const ParseError&) {
    return;
  }
  const std::string written = effort::format_cuts(place.database());
  require(effort::import_cuts(place.database(), place.table(written)) == 2);
  require(effort::format_cuts(place.database()) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static Place place;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  take_labels(place, text);
  take_cuts(place, text);
  return 0;
}
