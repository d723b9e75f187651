// SPDX-License-Identifier: MIT
// Opening a fragment database, its clips and its fragments. fragment_schema.h holds the tables, frame_chunks.h how
// frames become bytes.
#include "effort/fragment_database_parts.h"
#include "effort/fragment_schema.h"
#include "effort/frame_chunks.h"
#include "effort/retarget.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>
#include <strut/motion/resample.h>

namespace strut::effort {
namespace {

using motion::FrameRange;

constexpr std::size_t kHeaderSize = 100;  // of every SQLite file (sqlite.org/fileformat)
constexpr std::size_t kVersionPlace = 60, kApplicationPlace = 68;
constexpr const char* kExpected = "a fragment database made by strut effort segment";

unsigned big_endian(std::string_view bytes, std::size_t place) {
  unsigned number = 0;
  for (std::size_t k = 0; k < 4; ++k) number = number << 8 | static_cast<unsigned char>(bytes[place + k]);
  return number;
}

std::string header_of(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kHeaderSize, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.is_open() || file.bad()) {
    throw FileError(FileAction::kRead, path, errno == 0 ? "cannot be read" : std::strerror(errno));
  }
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

void check_kind(const std::string& path) {
  const std::string header = header_of(path);
  if (header.empty()) throw ParseError(path, 0, 0, kExpected, "an empty file");
  if (!is_fragment_database(header)) throw ParseError(path, 0, 0, kExpected, "another kind of file");
  const unsigned version = big_endian(header, kVersionPlace);
  if (version != kFormatVersion) throw VersionError(path, static_cast<int>(version), kFormatVersion);
}

/// A crash may have left a journal that has to be played back before anything can be read, which takes writing.
void recover(const std::string& path) {
  const Connection writing(path, true);
  Statement look = writing.prepare("SELECT count(*) FROM sqlite_schema");
  look.run();
}

[[noreturn]] void refuse_content(const std::string& path, const std::string& found) {
  throw ParseError(path, 0, 0, "an intact fragment database", found, "take an earlier copy of it");
}

std::shared_ptr<const Skeleton> read_skeleton(const Connection& connection) {
  std::vector<Joint> joints;
  Statement rows = connection.prepare("SELECT name, parent, x, y, z, end_x, end_y, end_z FROM joints ORDER BY joint");
  while (rows.next()) {
    Joint joint{rows.text(0), static_cast<int>(rows.integer(1)), {rows.number(2), rows.number(3), rows.number(4)}};
    joint.has_end_site = !rows.is_null(5);
    if (joint.has_end_site) joint.end_site = {rows.number(5), rows.number(6), rows.number(7)};
    joints.push_back(std::move(joint));
  }
  return std::make_shared<const Skeleton>(std::move(joints));
}

void write_skeleton(const Connection& connection, const Skeleton& skeleton) {
  Statement row = connection.prepare("INSERT INTO joints VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    const Joint& joint = skeleton.joint(j);
    row.bind(0, j).bind(1, joint.name).bind(2, joint.parent);
    for (int k = 0; k < 3; ++k) {
      row.bind(3 + k, joint.offset[k]).bind(6 + k, joint.has_end_site ? joint.end_site[k] : kNotRated);
    }
    row.run();
  }
}

std::string in_words(const FrameRange& range) {
  return std::to_string(range.begin) + " to " + std::to_string(range.end);
}

void check_cuts(const std::vector<FrameRange>& cuts, int num_frames) {
  int free = 0;
  for (const FrameRange& cut : cuts) {
    if (cut.begin < free || cut.end <= cut.begin || cut.end > num_frames) {
      throw InvalidArgument("cuts", "ascending, separate ranges within 0 and " + std::to_string(num_frames),
                            in_words(cut));
    }
    free = cut.end;
  }
}

std::vector<FrameRange> rescaled(const std::vector<FrameRange>& cuts, double factor, int num_frames) {
  std::vector<FrameRange> scaled;
  for (const FrameRange& cut : cuts) {
    const auto frame = [&](int index) {
      return std::clamp(static_cast<int>(std::lround(index * factor)), 0, num_frames);
    };
    const int begin = std::max(frame(cut.begin), scaled.empty() ? 0 : scaled.back().end);
    if (frame(cut.end) > begin) scaled.push_back({begin, frame(cut.end)});
  }
  return scaled;
}

/// `motion` on the database's body: another actor's stands, steps and travels as that body would.
Motion on_body(const std::string& name, const Motion& motion, const std::shared_ptr<const Skeleton>& body,
               Diagnostics* diagnostics) {
  if (is_same(motion.skeleton(), *body)) return motion;
  const double here = leg_length(motion), there = leg_length(on_skeleton(motion, body, 1.0));
  const double scale = here > 0.0 && there > 0.0 ? there / here : 1.0;
  constexpr double kRounding = 1e-3;  // of bone lengths as files write them
  if (std::abs(scale - 1.0) > kRounding && diagnostics != nullptr) {
    diagnostics->note(name, "another body: put on the database's, travel and height scaled by " +
                                std::to_string(scale).substr(0, 5) + " as its legs are");
  }
  return on_skeleton(motion, body, scale);
}

const char* name_of(CutSource source) {
  return source == CutSource::kPerson ? "person" : "suggestion";
}

constexpr const char* kFragments =
    "SELECT f.id, f.clip, c.name, c.performer, c.action, f.begin_frame, f.end_frame, f.cut_by, f.content "
    "FROM fragments f JOIN clips c ON c.id = f.clip ";
constexpr const char* kInOrder = "ORDER BY f.clip, f.begin_frame, f.end_frame";

FragmentRecord fragment_of(const Statement& row) {
  return {row.integer(0),
          row.integer(1),
          row.text(2),
          row.text(3),
          row.text(4),
          {static_cast<int>(row.integer(5)), static_cast<int>(row.integer(6))},
          row.text(7) == "person" ? CutSource::kPerson : CutSource::kSuggested,
          row.is_null(8) ? -1 : static_cast<int>(row.integer(8))};
}

std::vector<FragmentRecord> all_of(Statement rows) {
  std::vector<FragmentRecord> fragments;
  while (rows.next()) fragments.push_back(fragment_of(rows));
  return fragments;
}

constexpr const char* kClips = "SELECT id, name, performer, action, frames FROM clips ";

ClipRecord clip_of(const Statement& row) {
  return {row.integer(0), row.text(1), row.text(2), row.text(3), static_cast<int>(row.integer(4))};
}

void write_frames(const Connection& connection, RecordId clip, const Motion& motion, const ChunkLayout& layout) {
  Statement chunk = connection.prepare("INSERT INTO chunks VALUES(?, ?, ?)");
  for (int begin = 0; begin < motion.num_frames(); begin += kFramesPerChunk) {
    const int end = std::min(begin + kFramesPerChunk, motion.num_frames());
    chunk.bind(0, clip).bind(1, begin / kFramesPerChunk).bind_blob(2, encode_frames(motion, begin, end, layout)).run();
  }
}

void write_fragments(const Connection& connection, RecordId clip, const std::vector<FrameRange>& cuts,
                     CutSource source) {
  Statement row = connection.prepare(
      "INSERT INTO fragments(clip, begin_frame, end_frame, cut_by) VALUES(?, ?, ?, ?) "
      "ON CONFLICT(clip, begin_frame, end_frame) DO UPDATE SET cut_by = excluded.cut_by");
  for (const FrameRange& cut : cuts)
    row.bind(0, clip).bind(1, cut.begin).bind(2, cut.end).bind(3, name_of(source)).run();
}

[[noreturn]] void refuse_labelled(const std::vector<FragmentRecord>& labelled) {
  std::string names;
  for (const FragmentRecord& fragment : labelled) {
    names += (names.empty() ? "" : ", ") + std::to_string(fragment.id) + " (" + fragment.clip_name + " " +
             in_words(fragment.frames) + ")";
  }
  throw InvalidArgument("cuts", "all labelled fragments to stay", "labels would be lost of fragment " + names);
}

[[noreturn]] void refuse_clip_id(RecordId clip) {
  throw InvalidArgument("clip", "the id of a clip", std::to_string(clip));
}

}  // namespace

bool is_fragment_database(std::string_view bytes) noexcept {
  using namespace std::string_view_literals;
  return bytes.size() >= kHeaderSize && bytes.starts_with("SQLite format 3\0"sv) &&
         big_endian(bytes, kApplicationPlace) == kApplicationId;
}

FragmentDatabase::FragmentDatabase(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
FragmentDatabase::FragmentDatabase(FragmentDatabase&&) noexcept = default;
FragmentDatabase& FragmentDatabase::operator=(FragmentDatabase&&) noexcept = default;
FragmentDatabase::~FragmentDatabase() = default;

FragmentDatabase FragmentDatabase::create(const std::string& path, const std::shared_ptr<const Skeleton>& skeleton,
                                          double frame_rate) {
  if (!skeleton) throw InvalidArgument("skeleton", "a skeleton", "none");
  if (!(frame_rate > 0.0) || !std::isfinite(frame_rate)) {
    throw InvalidArgument("frame_rate", "a positive number of frames per second", std::to_string(frame_rate));
  }
  const Connection memory(":memory:", true);
  memory.execute(kSchema);
  memory.prepare("INSERT INTO meta VALUES('frame_rate', ?)").bind(0, frame_rate).run();
  write_skeleton(memory, *skeleton);
  // Whole or not at all, as every file.
  write_file(path, memory.bytes());
  return open(path, Access::kReadWrite);
}

FragmentDatabase FragmentDatabase::open(const std::string& path, Access access) {
  check_kind(path);
  auto parts = std::make_unique<Parts>(path, access);
  if (!parts->connection.is_readable()) {
    recover(path);
    parts = std::make_unique<Parts>(path, access);
  }
  Statement rate = parts->connection.prepare("SELECT value FROM meta WHERE key = 'frame_rate'");
  if (rate.next()) parts->frame_rate = rate.number(0);
  if (!(parts->frame_rate > 0.0) || !std::isfinite(parts->frame_rate)) refuse_content(path, "no frame rate");
  try {
    parts->skeleton = read_skeleton(parts->connection);
  } catch (const InvalidArgument& error) {
    refuse_content(path, error.what());
  }
  return FragmentDatabase(std::move(parts));
}

const std::string& FragmentDatabase::path() const noexcept {
  return parts_->connection.path();
}
const std::shared_ptr<const Skeleton>& FragmentDatabase::skeleton() const noexcept {
  return parts_->skeleton;
}
double FragmentDatabase::frame_rate() const noexcept {
  return parts_->frame_rate;
}

DatabaseCounts FragmentDatabase::counts() const {
  Statement row = parts_->connection.prepare(
      "SELECT (SELECT count(*) FROM clips), (SELECT coalesce(sum(frames), 0) FROM clips), "
      "(SELECT count(*) FROM fragments), (SELECT count(DISTINCT content) FROM fragments), "
      "(SELECT count(*) FROM blends), (SELECT count(*) FROM labels), (SELECT count(DISTINCT rater) FROM labels), "
      "(SELECT count(*) FROM estimates), (SELECT count(*) FROM pairs) + (SELECT count(*) FROM decisions d WHERE NOT "
      "EXISTS (SELECT 1 FROM pairs p WHERE p.first = d.first AND p.second = d.second)), "
      "(SELECT count(*) FROM pairs p WHERE accepted AND NOT EXISTS (SELECT 1 FROM decisions d WHERE p.first = d.first "
      "AND p.second = d.second)) + (SELECT count(*) FROM decisions WHERE accepted)");
  row.next();
  return {row.integer(0), row.integer(1), row.integer(2), row.integer(3), row.integer(8),
          row.integer(9), row.integer(4), row.integer(5), row.integer(6), row.integer(7)};
}

void FragmentDatabase::check_integrity() const {
  Statement check = parts_->connection.prepare("PRAGMA integrity_check(1)");
  if (!check.next() || check.text(0) != "ok") refuse_content(path(), check.text(0));
  Statement references = parts_->connection.prepare("PRAGMA foreign_key_check");
  if (references.next()) refuse_content(path(), "references to what is not there, in " + references.text(0));
}

RecordId FragmentDatabase::add_clip(const NewClip& clip, const Motion& motion, const std::vector<FrameRange>& cuts,
                                    CutSource source, Diagnostics* diagnostics) {
  const std::string mismatch = describe_mismatch(*parts_->skeleton, motion.skeleton());
  if (!mismatch.empty()) throw SkeletonMismatch("not the skeleton of " + path() + ": " + mismatch);
  if (clip.name.empty()) throw InvalidArgument("name", "a clip's name", "an empty one");
  if (find_clip(clip.name)) throw InvalidArgument("name", "a new clip", "'" + clip.name + "', which is there already");
  if (motion.num_frames() == 0) throw InvalidArgument("motion", "at least one frame", "none");
  check_cuts(cuts, motion.num_frames());
  const bool same_rate = std::abs(motion.frame_rate() / frame_rate() - 1.0) < 1e-6;
  const Motion fitted = on_body(clip.name, motion, skeleton(), diagnostics);
  const Motion kept = same_rate ? fitted : motion::resample(fitted, frame_rate());
  if (!same_rate && diagnostics != nullptr) {
    diagnostics->note(clip.name, "resampled from " + std::to_string(motion.frame_rate()) + " to " +
                                     std::to_string(frame_rate()) + " frames/s, the database's");
  }
  const ChunkLayout layout = layout_of(kept);
  Connection& connection = parts_->connection;
  Change change(connection);
  connection.prepare("INSERT INTO clips(name, performer, action, frames, rest, moving) VALUES(?, ?, ?, ?, ?, ?)")
      .bind(0, clip.name)
      .bind(1, clip.performer)
      .bind(2, clip.action)
      .bind(3, kept.num_frames())
      .bind_blob(4, encode_rest(layout))
      .bind_blob(5, encode_moving(layout))
      .run();
  const RecordId id = connection.last_id();
  write_frames(connection, id, kept, layout);
  const double factor = frame_rate() / motion.frame_rate();
  write_fragments(connection, id, same_rate ? cuts : rescaled(cuts, factor, kept.num_frames()), source);
  change.commit();
  return id;
}

void FragmentDatabase::remove_clip(RecordId clip, OnLabels labels) {
  const std::vector<FragmentRecord> labelled = labelled_without(clip, {});
  if (labels == OnLabels::kRefuse && !labelled.empty()) refuse_labelled(labelled);
  Change change(parts_->connection);
  parts_->connection.prepare("DELETE FROM clips WHERE id = ?").bind(0, clip).run();
  if (parts_->connection.changes() == 0) refuse_clip_id(clip);
  change.commit();
}

void FragmentDatabase::describe_clip(RecordId clip, const std::string& performer, const std::string& action) {
  Change change(parts_->connection);
  parts_->connection.prepare("UPDATE clips SET performer = ?, action = ? WHERE id = ?")
      .bind(0, performer)
      .bind(1, action)
      .bind(2, clip)
      .run();
  if (parts_->connection.changes() == 0) refuse_clip_id(clip);
  change.commit();
}

std::vector<ClipRecord> FragmentDatabase::clips() const {
  std::vector<ClipRecord> clips;
  Statement rows = parts_->connection.prepare(std::string(kClips) + "ORDER BY id");
  while (rows.next()) clips.push_back(clip_of(rows));
  return clips;
}

std::optional<ClipRecord> FragmentDatabase::find_clip(const std::string& name) const {
  Statement row = parts_->connection.prepare(std::string(kClips) + "WHERE name = ?");
  row.bind(0, name);
  return row.next() ? std::optional(clip_of(row)) : std::nullopt;
}

Motion FragmentDatabase::motion(RecordId clip) const {
  Statement row = parts_->connection.prepare("SELECT frames FROM clips WHERE id = ?");
  row.bind(0, clip);
  if (!row.next()) refuse_clip_id(clip);
  return motion(clip, {0, static_cast<int>(row.integer(0))});
}

Motion FragmentDatabase::motion(RecordId clip, const FrameRange& range) const {
  Statement row = parts_->connection.prepare("SELECT frames, rest, moving FROM clips WHERE id = ?");
  row.bind(0, clip);
  if (!row.next()) refuse_clip_id(clip);
  if (range.begin < 0 || range.end < range.begin || range.end > row.integer(0)) {
    throw InvalidArgument("range", "frames within 0 and " + std::to_string(row.integer(0)), in_words(range));
  }
  try {
    const ChunkLayout layout = decode_layout(row.blob(1), row.blob(2), skeleton()->num_joints());
    std::vector<Pose> frames;
    frames.reserve(static_cast<std::size_t>(range.num_frames()));
    Statement chunks = parts_->connection.prepare(
        "SELECT chunk, frames FROM chunks WHERE clip = ? AND chunk BETWEEN ? AND ? ORDER BY chunk");
    chunks.bind(0, clip).bind(1, range.begin / kFramesPerChunk).bind(2, (range.end - 1) / kFramesPerChunk);
    while (std::ssize(frames) < range.num_frames() && chunks.next()) {
      const int first = static_cast<int>(chunks.integer(0)) * kFramesPerChunk;
      const int begin = std::max(range.begin - first, 0), end = std::min(range.end - first, kFramesPerChunk);
      decode_frames(chunks.blob(1), begin, end, layout, frames);
    }
    if (std::ssize(frames) != range.num_frames()) refuse_content(path(), "frames that are missing");
    return {skeleton(), frame_rate(), std::move(frames)};
  } catch (const InvalidArgument& error) {
    refuse_content(path(), error.what());
  }
}

std::vector<FragmentRecord> FragmentDatabase::fragments() const {
  return all_of(parts_->connection.prepare(std::string(kFragments) + kInOrder));
}

std::optional<FragmentRecord> FragmentDatabase::find_fragment(RecordId fragment) const {
  Statement row = parts_->connection.prepare(std::string(kFragments) + "WHERE f.id = ?");
  row.bind(0, fragment);
  return row.next() ? std::optional(fragment_of(row)) : std::nullopt;
}

std::vector<FragmentRecord> FragmentDatabase::labelled_without(RecordId clip,
                                                               const std::vector<FrameRange>& cuts) const {
  Statement rows = parts_->connection.prepare(
      std::string(kFragments) +
      "WHERE f.clip = ? AND (EXISTS (SELECT 1 FROM labels l WHERE l.fragment = f.id) OR EXISTS (SELECT 1 FROM blends b "
      "JOIN labels l ON l.blend = b.id WHERE b.first = f.id OR b.second = f.id)) " +
      kInOrder);
  rows.bind(0, clip);
  std::vector<FragmentRecord> gone;
  while (rows.next()) {
    FragmentRecord fragment = fragment_of(rows);
    if (std::find(cuts.begin(), cuts.end(), fragment.frames) == cuts.end()) gone.push_back(std::move(fragment));
  }
  return gone;
}

void FragmentDatabase::set_cuts(RecordId clip, const std::vector<FrameRange>& cuts, CutSource source, OnLabels labels) {
  Connection& connection = parts_->connection;
  Statement length = connection.prepare("SELECT frames FROM clips WHERE id = ?");
  length.bind(0, clip);
  if (!length.next()) refuse_clip_id(clip);
  check_cuts(cuts, static_cast<int>(length.integer(0)));
  length.reset();
  Change change(connection);
  const std::vector<FragmentRecord> labelled = labelled_without(clip, cuts);
  if (labels == OnLabels::kRefuse && !labelled.empty()) refuse_labelled(labelled);
  Statement before = connection.prepare(std::string(kFragments) + "WHERE f.clip = ?");
  before.bind(0, clip);
  Statement remove = connection.prepare("DELETE FROM fragments WHERE id = ?");
  std::vector<FrameRange> added = cuts;
  while (before.next()) {
    const FragmentRecord fragment = fragment_of(before);
    if (std::erase(added, fragment.frames) == 0) remove.bind(0, fragment.id).run();
  }
  before.reset();
  write_fragments(connection, clip, added, source);
  change.commit();
}

struct FragmentDatabase::Transaction::Scope {
  explicit Scope(Connection& connection) : change(connection) {}
  Change change;
};

FragmentDatabase::Transaction::Transaction(FragmentDatabase& database)
    : scope_(std::make_unique<Scope>(database.parts_->connection)) {}
FragmentDatabase::Transaction::~Transaction() = default;
void FragmentDatabase::Transaction::commit() {
  scope_->change.commit();
}

}  // namespace strut::effort
