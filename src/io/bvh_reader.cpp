// SPDX-License-Identifier: MIT
// Puts together what the header, the rows and the guesses give: text to poses, row by row or all at once.
#include "bvh_header.h"
#include "bvh_lines.h"
#include "bvh_motion.h"
#include "bvh_text.h"
#include "bvh_units.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include <strut/io/bvh.h>
#include <strut/io/bvh_stream.h>

namespace strut {
namespace {

using io::detail::BodyExtent;
using io::detail::BvhCursor;
using io::detail::BvhHeader;
using io::detail::JointColumns;

// Bodies outside these heights are usually a misread unit rather than a very small or large person.
constexpr double kSmallestBody = 0.8;  // [m]
constexpr double kLargestBody = 2.8;   // [m]; arms raised count

struct Units {
  LengthUnit unit;
  UpAxis up;
};

std::string short_number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3).ptr};
}

void report_units(const Units& units, double height, const BvhReadOptions& options, const std::string& name,
                  Diagnostics& diagnostics) {
  const double metres = height * metres_per(units.unit);
  std::string assumed;
  if (!options.unit) {
    assumed = std::string("lengths read as ") + plural_name(units.unit) + " (the skeleton spans " +
              short_number(height) + ")";
  }
  if (!options.up) assumed += std::string(assumed.empty() ? "" : ", ") + axis_name(units.up) + " as up";
  if (!assumed.empty()) diagnostics.note(name, assumed);
  if (metres < kSmallestBody || metres > kLargestBody) {
    diagnostics.warn(name, "the skeleton spans " + short_number(metres) + " m, which no person does",
                     options.unit ? "" : "give the unit if the guess is wrong");
  }
}

Units find_units(const std::vector<Joint>& joints, const Pose* first_frame, const BvhReadOptions& options,
                 const std::string& name, Diagnostics* diagnostics) {
  const Skeleton skeleton(joints);
  const BodyExtent rest = io::detail::body_extent(skeleton, rest_pose(skeleton));
  const BodyExtent first = first_frame != nullptr ? io::detail::body_extent(skeleton, *first_frame) : rest;
  const double height = std::max(rest.largest(), first.largest());
  const Units units = {options.unit.value_or(io::detail::guess_unit(height)),
                       options.up.value_or(io::detail::guess_up(first, rest))};
  if (diagnostics != nullptr) report_units(units, height, options, name, *diagnostics);
  return units;
}

std::vector<Joint> in_metres_y_up(std::vector<Joint> joints, const Units& units) {
  const double scale = metres_per(units.unit);
  for (Joint& joint : joints) {
    joint.offset = scale * io::detail::to_y_up(joint.offset, units.up);
    joint.end_site = scale * io::detail::to_y_up(joint.end_site, units.up);
  }
  return joints;
}

void bring_to_metres_y_up(Pose& pose, const Units& units) {
  const double scale = metres_per(units.unit);
  for (auto& translation : pose.translations) translation = scale * io::detail::to_y_up(translation, units.up);
  if (units.up == UpAxis::kY) return;
  for (auto& rotation : pose.rotations) rotation = io::detail::to_y_up(rotation, units.up);
}

std::string line_end_of(std::string_view text) {
  const auto end = text.find('\n');
  return end != text.npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

}  // namespace

struct BvhRowReader::Source {
  /// A whole text, whose first row is there to guess from.
  Source(std::string_view text, const std::string& given_name, const BvhReadOptions& read_options,
         Diagnostics* diagnostics)
      : name(given_name), options(read_options), cursor(text, name) {
    begin(true, diagnostics);
  }
  Source(ReadBytes read, const std::string& given_name, const BvhReadOptions& read_options, Diagnostics* diagnostics)
      : name(given_name), options(read_options), lines(std::in_place, std::move(read), name), cursor(*lines, name) {
    begin(!options.unit || !options.up, diagnostics);
  }

  void begin(bool looks_at_first_row, Diagnostics* diagnostics) {
    header = io::detail::parse_header(cursor);
    columns = io::detail::columns_of(header.channels);
    rows.emplace(cursor, header, diagnostics);
    Pose first;
    if (looks_at_first_row && read_row()) {
      has_first_row = true;
      io::detail::pose_from_row(row.data(), columns, header.joints, options.positions, first);
    }
    units = find_units(header.joints, has_first_row ? &first : nullptr, options, name, diagnostics);
    skeleton = std::make_shared<const Skeleton>(in_metres_y_up(header.joints, units));
    make_layout();
  }

  void make_layout() {
    layout.channels = header.channels;
    layout.unit = units.unit;
    layout.up = units.up;
    layout.positions = options.positions;
    layout.header = header.text;
    layout.frame_time_lead = header.frame_time_lead;
    layout.frame_time = header.frame_time;
    layout.frame_rate = header.frame_rate;
    layout.skeleton = skeleton;
    layout.line_end = line_end_of(header.text);
  }

  bool read_row() {
    row.clear();
    return rows->next(row);
  }

  bool next(Pose& pose) {
    if (!has_first_row && !read_row()) return false;
    has_first_row = false;
    ++num_given;
    io::detail::pose_from_row(row.data(), columns, header.joints, options.positions, pose);
    bring_to_metres_y_up(pose, units);
    return true;
  }

  std::string name;
  BvhReadOptions options;
  std::optional<io::detail::BvhLines> lines;
  BvhCursor cursor;
  BvhHeader header;
  std::optional<io::detail::BvhRows> rows;
  std::vector<JointColumns> columns;
  Units units{};
  std::shared_ptr<const Skeleton> skeleton;
  BvhLayout layout;
  std::vector<double> row;
  bool has_first_row = false;  // in `row`, not given yet
  long long num_given = 0;
};

BvhRowReader::BvhRowReader(ReadBytes read, const std::string& name, const BvhReadOptions& options,
                           Diagnostics* diagnostics)
    : source_(std::make_unique<Source>(std::move(read), name, options, diagnostics)) {}

BvhRowReader::BvhRowReader(std::unique_ptr<Source> source) : source_(std::move(source)) {}

BvhRowReader::BvhRowReader(BvhRowReader&&) noexcept = default;
BvhRowReader& BvhRowReader::operator=(BvhRowReader&&) noexcept = default;
BvhRowReader::~BvhRowReader() = default;

BvhRowReader BvhRowReader::of_text(std::string_view text, const std::string& name, const BvhReadOptions& options,
                                   Diagnostics* diagnostics) {
  return BvhRowReader(std::make_unique<Source>(text, name, options, diagnostics));
}

bool BvhRowReader::next(Pose& pose) {
  return source_->next(pose);
}

std::span<const double> BvhRowReader::row() const noexcept {
  return source_->row;
}

long long BvhRowReader::num_rows() const noexcept {
  return source_->num_given;
}

long long BvhRowReader::claimed_frames() const noexcept {
  return source_->header.num_frames;
}

const std::shared_ptr<const Skeleton>& BvhRowReader::shared_skeleton() const noexcept {
  return source_->skeleton;
}

double BvhRowReader::frame_rate() const noexcept {
  return source_->header.frame_rate;
}

const BvhLayout& BvhRowReader::layout() const noexcept {
  return source_->layout;
}

BvhClip parse_bvh(std::string_view text, const std::string& name, const BvhReadOptions& options,
                  Diagnostics* diagnostics) {
  BvhRowReader reader = BvhRowReader::of_text(text, name, options, diagnostics);
  BvhLayout layout = reader.layout();
  // A number takes at least two characters, so the text bounds what the header may claim.
  const auto width = static_cast<std::size_t>(layout.num_channels());
  const std::size_t room = std::min(text.size() / (2 * width) + 1, static_cast<std::size_t>(reader.claimed_frames()));
  std::vector<Pose> frames;
  std::vector<double> values;
  frames.reserve(room);
  values.reserve(room * width);
  for (Pose pose; reader.next(pose);) {
    frames.push_back(pose);
    values.insert(values.end(), reader.row().begin(), reader.row().end());
  }
  layout.source_values = std::make_shared<const std::vector<double>>(std::move(values));
  return {Motion(reader.shared_skeleton(), reader.frame_rate(), std::move(frames)), std::move(layout)};
}

BvhClip read_bvh(const std::string& path, const BvhReadOptions& options, Diagnostics* diagnostics) {
  return parse_bvh(read_file(path), path, options, diagnostics);
}

}  // namespace strut
